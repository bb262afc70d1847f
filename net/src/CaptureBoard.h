#pragma once

#include <gnomon/net/HubTypes.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::net {

/// Collects the pictures of captured frames until they are taken; keeps the newest two frames'.
class CaptureBoard {
public:
    /// @param maxBytes  of one frame's pictures from one server; it holds no more back itself
    explicit CaptureBoard(std::uint64_t maxBytes = std::uint64_t{2} << 30U) : maxBytes_{maxBytes} {}

    void begin(std::uint64_t n, const std::vector<std::string>& members) {
        Capture& capture = captures_[n];
        for (const auto& name : members) capture.awaited[name] = {};
        while (captures_.size() > 2) captures_.erase(captures_.begin());
    }
    /// A server says how many pictures of frame n it sent.
    void expect(std::uint64_t n, const std::string& server, std::uint32_t images) {
        const auto found = captures_.find(n);
        if (found != captures_.end()) found->second.awaited[server].expected = images;
    }
    Result<void> add(const std::string& server, Image image) {
        const auto found = captures_.find(image.n);
        if (found == captures_.end()) return {};  // nobody waits for it any more
        Server& from = found->second.awaited[server];
        const std::uint64_t bytes = image.pixels.size() + sizeof(TileImage);
        if (bytes > maxBytes_ - from.bytes)
            return fail(Errc::limit, "more than " + std::to_string(maxBytes_) +
                                         " bytes of pictures of frame " + std::to_string(image.n));
        from.bytes += bytes;
        ++from.arrived;
        found->second.images.push_back({.server = server, .image = std::move(image)});
        return {};
    }
    void lost(const std::string& server) {
        for (auto& [n, capture] : captures_) {
            const auto found = capture.awaited.find(server);
            if (found != capture.awaited.end() && !found->second.complete())
                capture.missing = server;
        }
    }
    /// Frame n is shown: nobody else will contribute.
    void shown(std::uint64_t n) {
        const auto found = captures_.find(n);
        if (found != captures_.end()) found->second.shown = true;
    }

    /// Nothing while pictures are still to come.
    std::optional<Result<std::vector<TileImage>>> take(std::uint64_t n) {
        using Outcome = Result<std::vector<TileImage>>;
        const auto found = captures_.find(n);
        if (found == captures_.end())
            return Outcome{fail(Errc::edit, "frame " + std::to_string(n) +
                                                " was not captured, or its pictures are taken")};
        Capture& capture = found->second;
        if (!capture.missing.empty()) {
            const std::string missing = capture.missing;
            captures_.erase(found);
            return Outcome{fail(Errc::disconnected, "server " + missing +
                                                        " was lost before its pictures of frame " +
                                                        std::to_string(n) + " arrived")};
        }
        if (!capture.shown) return {};
        for (const auto& [name, server] : capture.awaited)
            if (!server.complete()) return {};
        auto images = std::move(capture.images);
        captures_.erase(found);
        return Outcome{std::move(images)};
    }

    /// Whose pictures of frame n are still to come, for an error text.
    std::string waitingFor(std::uint64_t n) const {
        const auto found = captures_.find(n);
        if (found == captures_.end()) return {};
        for (const auto& [name, server] : found->second.awaited)
            if (!server.complete()) return name;
        return {};
    }

private:
    struct Server {
        std::optional<std::uint32_t> expected = {};
        std::uint32_t arrived = 0;
        std::uint64_t bytes = 0;
        bool complete() const { return expected && arrived >= *expected; }
    };
    struct Capture {
        std::map<std::string, Server> awaited = {};
        std::vector<TileImage> images = {};
        std::string missing = {};
        bool shown = false;
    };
    const std::uint64_t maxBytes_;
    std::map<std::uint64_t, Capture> captures_;
};

}  // namespace gnomon::net
