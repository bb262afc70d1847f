#include "client/Receiver.h"

#include <gnomon/field/Wire.h>
#include <gnomon/scene/Types.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>

#include "format/Format.h"

namespace gnomon::importer {
namespace {

constexpr std::size_t maxErrorBytes = std::size_t{64} << 10U;
/// Room that is made at once for what a length field promises; more as it arrives.
constexpr std::uint64_t firstStep = std::uint64_t{1} << 20U;

}  // namespace

Receiver::Receiver(int output, int errors, Clock::time_point deadline, Progress progress)
    : out_{output}, err_{errors}, deadline_{deadline}, progress_{std::move(progress)} {}

void Receiver::takeErrors() {
    std::array<char, 4096> buffer{};
    const auto count = ::read(err_, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) return;
    if (count <= 0) {
        err_ = -1;
        if (errors_.size() < maxErrorBytes) errors_ += partial_;
        partial_.clear();
        return;
    }
    partial_.append(buffer.data(), static_cast<std::size_t>(count));
    for (std::size_t end = 0; (end = partial_.find('\n')) != std::string::npos;) {
        const std::string line = partial_.substr(0, end);
        partial_.erase(0, end + 1);
        if (line.rfind(progressMark, 0) != 0) {
            if (errors_.size() < maxErrorBytes) errors_ += line + '\n';
            continue;
        }
        double share = 0.0;
        const char* last = line.data() + line.size();
        const auto [at, ec] = std::from_chars(line.data() + progressMark.size(), last, share);
        if (ec == std::errc{} && progress_)
            progress_(std::clamp(share, 0.0, 1.0), at == last ? "" : std::string{at + 1, last});
    }
    if (partial_.size() > maxErrorBytes) partial_.resize(maxErrorBytes);
}

Result<bool> Receiver::await() {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
    if (left <= 0) return fail(Errc::timeout, "the deadline passed");
    std::array<pollfd, 2> pipes{pollfd{out_, POLLIN, 0}, pollfd{err_, POLLIN, 0}};
    ::poll(pipes.data(), err_ >= 0 ? 2 : 1, static_cast<int>(std::min<long>(left, 60000)));
    if (err_ >= 0 && pipes[1].revents != 0) takeErrors();
    return pipes[0].revents != 0;
}

Result<void> Receiver::read(std::span<std::byte> to) {
    while (!to.empty()) {
        const auto readable = await();
        if (!readable) return tl::unexpected{readable.error()};
        if (!*readable) continue;
        const auto count = ::read(out_, to.data(), to.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return fail(Errc::disconnected, "the importer's output ends early");
        to = to.subspan(static_cast<std::size_t>(count));
    }
    return {};
}

Result<std::vector<std::byte>> Receiver::readBlock(std::uint64_t size) {
    std::vector<std::byte> bytes;
    while (bytes.size() < size) {
        const auto have = bytes.size();
        const auto step =
            std::min<std::uint64_t>(size - have, std::max<std::uint64_t>(have, firstStep));
        bytes.resize(have + static_cast<std::size_t>(step));
        const auto done = read(std::span{bytes}.subspan(have));
        if (!done) return tl::unexpected{done.error()};
    }
    return bytes;
}

Result<field::ChangeList> Receiver::receive(std::uint64_t maxBytes) {
    std::array<std::byte, StreamHeader::bytes> head{};
    if (auto done = read(head); !done) return tl::unexpected{done.error()};
    const auto header = decodedHeader(head);
    if (!header) return fail(Errc::protocol, "the importer's output has no header of ours");
    field::TypeRegistry types;
    scene::addTypes(types);
    if (header->types != typesDigest(types))
        return fail(Errc::protocol,
                    "the importer is of another version of Gnomon than this program");
    if (header->listBytes > maxBytes || header->payloadBytes > maxBytes - header->listBytes)
        return fail(Errc::limit, "the scene is larger than the " + std::to_string(maxBytes) +
                                     " bytes it may have");
    field::ChangeList list;
    auto bytes = readBlock(header->listBytes);
    if (!bytes) return tl::unexpected{std::move(bytes).error()};
    list.bytes = *std::move(bytes);

    std::uint64_t left = header->payloadBytes;
    for (std::uint64_t i = 0; i < header->payloads; ++i) {
        std::array<std::byte, payloadHeadBytes> raw{};
        if (auto done = read(raw); !done) return tl::unexpected{done.error()};
        field::Reader from{raw};
        field::Hash128 hash;
        hash.low = from.scalar<std::uint64_t>();
        hash.high = from.scalar<std::uint64_t>();
        const auto size = from.scalar<std::uint64_t>();
        if (size > left || size == 0)
            return fail(Errc::protocol, "payload " + std::to_string(i) + " of the importer's has " +
                                            std::to_string(size) + " bytes, expected 1 to " +
                                            std::to_string(left));
        left -= size;
        auto data = readBlock(size);
        if (!data) return tl::unexpected{std::move(data).error()};
        field::Payload payload{*std::move(data)};
        if (payload.hash() != hash)
            return fail(Errc::protocol, "payload " + std::to_string(i) +
                                            " of the importer's does not have its hash");
        list.payloads.push_back(std::move(payload));
    }
    std::array<std::byte, 4> end{};
    if (auto done = read(end); !done) return tl::unexpected{done.error()};
    if (left != 0 || field::Reader{end}.scalar<std::uint32_t>() != StreamHeader::endMagic)
        return fail(Errc::protocol, "the importer's output does not end as it should");
    return list;
}

Result<std::uint64_t> Receiver::drain() {
    std::array<std::byte, 4096> buffer{};
    std::uint64_t thrownAway = 0;
    for (bool open = true; open || err_ >= 0;) {
        if (!open) {  // a closed pipe would wake poll() again and again
            const auto left =
                std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now());
            if (left.count() <= 0) return fail(Errc::timeout, "the deadline passed");
            pollfd entry{err_, POLLIN, 0};
            if (::poll(&entry, 1, static_cast<int>(std::min<long>(left.count(), 60000))) > 0)
                takeErrors();
            continue;
        }
        const auto readable = await();
        if (!readable) return tl::unexpected{readable.error()};
        if (!*readable) continue;
        const auto count = ::read(out_, buffer.data(), buffer.size());
        open = count > 0 || (count < 0 && errno == EINTR);
        if (count > 0) thrownAway += static_cast<std::uint64_t>(count);
    }
    return thrownAway;
}

std::string Receiver::complaint() const {
    constexpr std::size_t longest = 1000;
    return errors_.substr(0, std::min(errors_.find('\n'), longest));
}

}  // namespace gnomon::importer
