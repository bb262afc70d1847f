#include "program/Send.h"

#include <gnomon/field/Wire.h>
#include <unistd.h>

#include <cerrno>
#include <span>
#include <unordered_set>

#include "format/Format.h"

namespace gnomon::importer {
namespace {

Result<void> writeAll(int fd, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const auto count = ::write(fd, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0)
            return fail(Errc::file, "writing the result", {errno, std::generic_category()});
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return {};
}

}  // namespace

Result<void> send(const field::ChangeList& list, const field::TypeRegistry& types, int fd) {
    // A payload that several fields name is in the list several times.
    std::vector<const field::Payload*> payloads;
    std::unordered_set<field::Hash128> seen;
    StreamHeader header{.types = typesDigest(types), .listBytes = list.bytes.size()};
    for (const auto& payload : list.payloads) {
        if (payload.size() == 0 || !seen.insert(payload.hash()).second) continue;
        payloads.push_back(&payload);
        header.payloadBytes += payload.size();
    }
    header.payloads = payloads.size();

    if (auto done = writeAll(fd, encoded(header)); !done) return done;
    if (auto done = writeAll(fd, list.bytes); !done) return done;
    for (const auto* payload : payloads) {
        field::Writer head;
        head.scalar(payload->hash().low);
        head.scalar(payload->hash().high);
        head.scalar(std::uint64_t{payload->size()});
        if (auto done = writeAll(fd, head.written()); !done) return done;
        if (auto done = writeAll(fd, payload->bytes()); !done) return done;
    }
    field::Writer end;
    end.scalar(StreamHeader::endMagic);
    return writeAll(fd, end.written());
}

}  // namespace gnomon::importer
