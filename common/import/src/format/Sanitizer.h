#pragma once

namespace gnomon::importer {

/// Sanitizers reserve terabytes of address space at start: with them it cannot be limited.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool reservesAddressSpace = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool reservesAddressSpace = true;
#else
inline constexpr bool reservesAddressSpace = false;
#endif
#else
inline constexpr bool reservesAddressSpace = false;
#endif

}  // namespace gnomon::importer
