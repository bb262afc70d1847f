#include "Statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace gnomon::client {

void Samples::add(double value) {
    const auto kept = static_cast<float>(value);
    if (values_.size() < most) {
        values_.push_back(kept);
        return;
    }
    values_[next_] = kept;
    next_ = (next_ + 1) % most;
}

double Samples::quantile(double share) const {
    if (values_.empty()) return 0.0;
    std::vector<float> sorted = values_;
    const double rank = std::ceil(share * static_cast<double>(sorted.size()));
    const auto index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
    const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>(index);
    std::nth_element(sorted.begin(), nth, sorted.end());
    return *nth;
}

void Statistics::add(const net::FrameResult& frame, const std::vector<net::ServerStatus>& servers,
                     Clock::time_point now) {
    ++frames_;
    ++recentFrames_;
    if (lastFrame_) {
        const double ms = std::chrono::duration<double, std::milli>(now - *lastFrame_).count();
        frameMs_.add(ms);
        recentMs_.add(ms);
    }
    lastFrame_ = now;
    if (!lastLine_) lastLine_ = now;
    if (frame.shown > 0) latencyMs_.add(frame.ms);
    if (frame.skewMs) {
        skewMs_.add(*frame.skewMs);
        recentSkew_.add(*frame.skewMs);
    }
    bytes_ += static_cast<double>(frame.bytes);
    payloadBytes_ += static_cast<double>(frame.payloadBytes);
    recentBytes_ += static_cast<double>(frame.bytes);
    if (!frame.waitedFor.empty()) ++recentLast_[frame.waitedFor];
    for (const auto& server : servers)
        if (server.state == net::ServerState::member)
            renderMs_[server.address.name].add(static_cast<double>(server.stats.renderMs));
}

std::optional<std::string> Statistics::line(Clock::time_point now) {
    if (!lastLine_ || now - *lastLine_ < std::chrono::seconds{1} || recentFrames_ == 0) return {};
    const double seconds = std::chrono::duration<double>(now - *lastLine_).count();
    const auto count = static_cast<double>(recentFrames_);
    std::string text = fmt::format(
        "frame {}  {:.1f} fps  median {:.2f} ms  skew {:.2f} ms  {:.0f} bytes/frame", frames_,
        count / seconds, recentMs_.median(), recentSkew_.median(), recentBytes_ / count);
    const auto last =
        std::max_element(recentLast_.begin(), recentLast_.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (last != recentLast_.end())
        text += fmt::format("  last {} ({:.0f} %)", last->first,
                            100.0 * static_cast<double>(last->second) / count);
    lastLine_ = now;
    recentMs_.clear();
    recentSkew_.clear();
    recentBytes_ = 0.0;
    recentFrames_ = 0;
    recentLast_.clear();
    return text;
}

std::string Statistics::summary() const {
    const double median = frameMs_.median();
    return fmt::format("{} frames, median {:.2f} ms ({:.1f} fps), 99 % below {:.2f} ms", frames_,
                       median, median > 0.0 ? 1000.0 / median : 0.0, frameMs_.quantile(0.99));
}

nlohmann::json Statistics::json(const std::vector<net::ServerStatus>& servers,
                                const net::HubTotals& totals) const {
    const auto count = static_cast<double>(std::max<std::uint64_t>(frames_, 1));
    nlohmann::json all = {
        {"frames", frames_},
        {"frame_ms",
         {{"median", frameMs_.median()},
          {"p99", frameMs_.quantile(0.99)},
          {"max", frameMs_.max()}}},
        {"latency_ms", {{"median", latencyMs_.median()}, {"p99", latencyMs_.quantile(0.99)}}},
        {"skew_ms", {{"median", skewMs_.median()}, {"p99", skewMs_.quantile(0.99)}}},
        {"bytes_per_frame", bytes_ / count},
        {"payload_bytes_per_frame", payloadBytes_ / count},
        {"sent",
         {{"control_bytes", totals.controlBytes},
          {"bulk_bytes", totals.bulkBytes},
          {"spared_bytes", totals.sparedBytes}}},
        {"servers", nlohmann::json::array()}};
    for (const auto& server : servers) {
        const auto found = renderMs_.find(server.address.name);
        const auto& stats = server.stats;
        all["servers"].push_back(
            {{"name", server.address.name},
             {"frame_ms", found == renderMs_.end() ? 0.0 : found->second.median()},
             {"lost", server.lost},
             {"rejoined", server.rejoined},
             {"description", server.description},
             {"trip_ms", server.tripMs ? nlohmann::json(*server.tripMs) : nlohmann::json()},
             {"triangles", stats.triangles},
             {"shadow_ms", stats.shadowMs},
             {"colour_ms", stats.colourMs},
             {"pages_drawn", stats.pagesDrawn},
             {"pages_kept", stats.pagesKept},
             {"pages_unseen", stats.pagesUnseen},
             {"chunks_culled", stats.chunksCulled},
             {"lights_unseen", stats.lightsUnseen},
             {"map_texels", stats.mapTexels},
             {"map_bytes", stats.mapBytes},
             {"degenerate", stats.degenerate}});
    }
    return all;
}

}  // namespace gnomon::client
