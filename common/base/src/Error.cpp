#include <gnomon/base/Error.h>

#include <cstdio>
#include <cstdlib>

namespace gnomon {

std::string_view name(Errc code) noexcept {
    switch (code) {
        case Errc::config:
            return "config";
        case Errc::context:
            return "context";
        case Errc::shader:
            return "shader";
        case Errc::protocol:
            return "protocol";
        case Errc::schema:
            return "schema";
        case Errc::timeout:
            return "timeout";
        case Errc::disconnected:
            return "disconnected";
        case Errc::edit:
            return "edit";
        case Errc::file:
            return "file";
        case Errc::limit:
            return "limit";
        case Errc::process:
            return "process";
    }
    return "unknown";
}

std::string Error::text() const { return cause ? what + ": " + cause.message() : what; }

namespace detail {

void contractBroken(const char* condition, const char* why, const char* file, int line) noexcept {
    std::fprintf(stderr, "%s:%d: broken contract: %s (%s)\n", file, line, why, condition);
    std::abort();
}

}  // namespace detail
}  // namespace gnomon
