#pragma once

#include <cstdint>
#include <string>

namespace gnomon::importer {

/// Limits this process: address space, no core file, and a clock that ends it with exit code 1 and
/// one line naming @p file. Called once.
void limitProcess(const std::string& file, std::uint64_t maxMemory, std::uint32_t maxSeconds);

}  // namespace gnomon::importer
