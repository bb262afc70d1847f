// What an importer that was taken over may write: refused, or a list that can be taken in. The
// first byte says how much of it comes as the importer's standard error.
#include <gnomon/field/Aspect.h>
#include <gnomon/scene/Types.h>
#include <unistd.h>

#include "Check.h"
#include "client/Receiver.h"

namespace gnomon::fuzz {
namespace {

/// A pipe that holds these bytes, and then ends.
class FullPipe {
public:
    explicit FullPipe(std::span<const std::uint8_t> bytes) {
        require(::pipe(ends_.data()) == 0, "there are pipes");
        bytes = bytes.first(std::min<std::size_t>(bytes.size(), 65536));  // what fits
        require(::write(ends_[1], bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
                "a pipe takes 64 KiB");
        ::close(ends_[1]);
    }
    ~FullPipe() { ::close(ends_[0]); }
    FullPipe(const FullPipe&) = delete;
    FullPipe& operator=(const FullPipe&) = delete;
    int end() const noexcept { return ends_[0]; }

private:
    std::array<int, 2> ends_{};
};

}  // namespace
}  // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon;
    using importer::Receiver;
    if (size == 0) return 0;
    const std::span<const std::uint8_t> rest{data + 1, size - 1};
    const auto words = std::min<std::size_t>(data[0], rest.size());
    const fuzz::FullPipe errors{rest.first(words)};
    const fuzz::FullPipe output{rest.subspan(words)};
    Receiver receiver{output.end(), errors.end(), Receiver::Clock::now() + std::chrono::seconds{60},
                      [](double share, const std::string&) {
                          fuzz::require(share >= 0 && share <= 1, "progress is a share");
                      }};
    const auto list = receiver.receive(std::uint64_t{1} << 32U);
    fuzz::require(receiver.drain().has_value(), "what ends can be read to its end");
    receiver.complaint();
    if (!list) return 0;
    field::TypeRegistry types;
    scene::addTypes(types);
    field::Aspect aspect{types, 2};
    static_cast<void>(aspect.adopt(*list));
    aspect.commit();
    return 0;
}
