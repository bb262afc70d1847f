#pragma once

#include <cstdint>
#include <exception>
#include <string>
#include <string_view>
#include <system_error>
#include <tl/expected.hpp>
#include <utility>

namespace gnomon {

/// Stable kinds of failure, for programs; listed in docs/errors.md.
enum class Errc : std::uint8_t {
    config,        ///< a configuration or command line value
    context,       ///< no usable OpenGL context, window or display
    shader,        ///< a shader does not compile or link
    protocol,      ///< bytes that break the protocol or the change-list format
    schema,        ///< two sides disagree about a container type
    timeout,       ///< a deadline passed
    disconnected,  ///< the other side is gone
    edit,          ///< an edit that would break the scene (cycle, destroying what is referenced)
    file,          ///< a file is missing, unreadable or malformed
    limit,         ///< a stated limit on size, memory or time was reached
    process,       ///< a child process could not be started or failed
};

std::string_view name(Errc code) noexcept;

/// Why something failed: a stable code for programs, a sentence for people,
/// and the system's own code when there was one.
struct Error {
    Errc code = Errc::config;
    std::string what = {};  ///< What was read, where, what was found, what was expected.
    std::error_code cause = {};

    /// The sentence, followed by the system's message where there is one.
    std::string text() const;
};

template <class T>
using Result = tl::expected<T, Error>;

/// `return fail(Errc::file, "...")` from any function that returns a Result.
inline tl::unexpected<Error> fail(Errc code, std::string what, std::error_code cause = {}) {
    return tl::unexpected<Error>{Error{.code = code, .what = std::move(what), .cause = cause}};
}

/// Carries an Error past code that cannot act on it.
class Failure final : public std::exception {
public:
    explicit Failure(Error error) : error_{std::move(error)}, text_{error_.text()} {}
    Failure(Errc code, std::string what) : Failure{Error{.code = code, .what = std::move(what)}} {}
    const char* what() const noexcept override { return text_.c_str(); }
    const Error& error() const noexcept { return error_; }

private:
    Error error_;
    std::string text_;
};

/// The value, or a throw: for a caller to whom any failure is final.
template <class T>
T orThrow(Result<T>&& result) {
    if (!result) throw Failure{std::move(result).error()};
    if constexpr (!std::is_void_v<T>) return *std::move(result);
}

namespace detail {
[[noreturn]] void contractBroken(const char* condition, const char* why, const char* file,
                                 int line) noexcept;
}

}  // namespace gnomon

/// Stops the program when a caller broke a contract: a bug of ours, never bad input.
#define GNOMON_EXPECTS(condition, why) \
    ((condition) ? void(0) : ::gnomon::detail::contractBroken(#condition, why, __FILE__, __LINE__))
