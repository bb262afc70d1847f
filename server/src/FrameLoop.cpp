#include "FrameLoop.h"

#include <gnomon/scene/Types.h>

#include <algorithm>
#include <cstdio>

namespace gnomon::server {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration d) {
    return std::chrono::duration<double, std::milli>(d).count();
}

std::int64_t nanosecondsNow() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch())
        .count();
}

net::EventKind kindOf(gl::InputEvent::Kind kind) {
    using Kind = gl::InputEvent::Kind;
    switch (kind) {
        case Kind::key:
            return net::EventKind::key;
        case Kind::button:
            return net::EventKind::button;
        case Kind::motion:
            return net::EventKind::move;
        case Kind::scroll:
            return net::EventKind::scroll;
        case Kind::close:
            return net::EventKind::close;
        case Kind::resize:
            return net::EventKind::resize;
    }
    return net::EventKind::key;
}

/// The key that was named; for other computers, else the usual one. @throws Failure
net::SharedKey keyOf(const Options& options) {
    std::filesystem::path file = options.key;
    if (file.empty() && net::needsKey(options.address)) {
        file = net::defaultKeyFile();
        std::error_code ec;
        if (!std::filesystem::exists(file, ec))
            throw Failure{Errc::config,
                          "cannot listen on " + options.address +
                              ": other computers may only connect with a cluster key; use --key "
                              "FILE, or make one with gnomon keygen"};
    }
    if (file.empty()) return {};
    return std::make_shared<const net::ClusterKey>(orThrow(net::ClusterKey::load(file)));
}

}  // namespace

FrameLoop::FrameLoop(Options options) : options_{std::move(options)} {
    const auto key = keyOf(options_);
    scene::addTypes(types_);
    std::string description = "no rendering (--backend none)";
    if (options_.backend != "none") description = station(options_.gpu).context().description();
    std::fprintf(stderr, "%s\n", description.c_str());
    net::ServerOptions made{.address = options_.address,
                            .port = options_.port,
                            .name = options_.name,
                            .description = description,
                            .exitWithClient = options_.exitWithClient,
                            .key = key,
                            .announce = options_.announce};
    made.turnedAway = [](const std::string& why) { std::fprintf(stderr, "%s\n", why.c_str()); };
    host_ = std::make_unique<net::ServerHost>(std::move(made), types_);
}

Station& FrameLoop::station(int gpu) {
    auto& slot = stations_[gpu];
    if (!slot) {
        const auto backend = orThrow(gl::parseBackend(options_.backend));
        slot = std::make_unique<Station>(backend, gpu, true);
        if (session_)
            slot->attach(*session_->scene,
                         [this](const std::string& t) { report(net::LogLevel::warning, t); });
    }
    return *slot;
}

Station& FrameLoop::stationOf(const scene::Window& window) {
    return station(window.gpu >= 0 ? window.gpu.get() : options_.gpu);
}

void FrameLoop::report(net::LogLevel level, const std::string& text) {
    host_->send(net::Log{.level = level, .text = text});
}

void FrameLoop::run() {
    using namespace std::chrono_literals;
    for (;;) {
        // Input is looked for between frames; without a display there is nothing to look for.
        const bool display = std::any_of(stations_.begin(), stations_.end(), [](const auto& entry) {
            return entry.second->hasDisplay();
        });
        auto event = host_->next(Clock::now() + (display ? 10ms : 10000ms));
        if (std::holds_alternative<net::Quit>(event)) return;
        if (const auto* joined = std::get_if<net::ClientJoined>(&event)) join(*joined);
        if (const auto* left = std::get_if<net::ClientLeft>(&event)) leave(left->why);
        if (session_) {
            if (const auto* snapshot = std::get_if<net::Snapshot>(&event)) take(*snapshot);
            if (const auto* frame = std::get_if<net::Frame>(&event)) take(*frame);
            if (const auto* fit = std::get_if<net::Fit>(&event)) take(*fit);
            if (const auto* swap = std::get_if<net::Swap>(&event)) show(swap->n);
        }
        if (display) sendEvents();
    }
}

void FrameLoop::join(const net::ClientJoined& joined) {
    std::fprintf(stderr, "client %s\n", joined.who.c_str());
    // Renderers look into the aspect until they have the new one.
    Session fresh;
    fresh.scene = std::make_unique<field::Aspect>(types_, std::uint16_t{0});
    for (auto& [gpu, station] : stations_)
        station->attach(*fresh.scene,
                        [this](const std::string& t) { report(net::LogLevel::warning, t); });
    session_ = std::move(fresh);
    shownFrame_ = 0;
    waiting_.reset();
}

void FrameLoop::leave(const std::string& why) {
    std::fprintf(stderr, "client left: %s\n", why.c_str());
    // The session stays as it is: its last picture is on the wall until the next client.
    waiting_.reset();
}

bool FrameLoop::apply(const field::ChangeList& changes) {
    field::Applied applied;
    auto done = session_->scene->apply(changes, &applied);
    if (!done) throw Failure{std::move(done).error()};
    if (applied.empty()) return false;
    findWindows(applied);
    for (auto& [gpu, station] : stations_) station->update(applied);
    return true;
}

void FrameLoop::findWindows(const field::Applied& applied) {
    auto& windows = session_->windows;
    const bool windowsChanged =
        !applied.destroyed.empty() ||
        std::any_of(applied.changed.begin(), applied.changed.end(), [&](const auto& change) {
            return session_->scene->get(scene::Ref<scene::Window>{change.id}) != nullptr;
        });
    if (!windowsChanged) return;
    windows.clear();
    session_->scene->forEach([&](const field::FieldContainer& container) {
        const auto* window = dynamic_cast<const scene::Window*>(&container);
        if (window != nullptr && window->server.get() == options_.name) windows.push_back(window);
    });
    std::sort(windows.begin(), windows.end(),
              [](const auto* a, const auto* b) { return a->id() < b->id(); });
}

void FrameLoop::take(const net::Snapshot& snapshot) {
    const auto since = Clock::now();
    apply(snapshot.changes);
    host_->setActivity(net::Activity::compiling);
    if (session_->windows.empty())
        report(net::LogLevel::warning,
               "no window of the scene bears the name \"" + options_.name + "\"");
    renderFrame(snapshot.n, snapshot.time, false, true, since);
}

void FrameLoop::take(const net::Frame& frame) {
    const auto since = Clock::now();
    const bool changed = apply(frame.changes);
    if (frame.wantsDepth) {
        tellDepth(frame.n, false);
        waiting_ = frame;
        waitingChanged_ = changed;
        return;
    }
    sendDigests(frame);
    // Behind: this frame may be shown already elsewhere, so only the newest is worth drawing.
    const auto queued = host_->peek();
    if (queued.newestFrame > frame.n && queued.newestSwap >= frame.n && !frame.capture) {
        session_->drawn = session_->drawn && !changed;
        ++session_->skipped;
        return;
    }
    renderFrame(frame.n, frame.time, frame.capture, changed, since, frame.tellsDepth);
}

void FrameLoop::sendDigests(const net::Frame& frame) {
    if (frame.digest) host_->send(net::Digest{.n = frame.n, .digest = session_->scene->digest()});
    if (frame.digests) host_->send(net::digestsOf(frame.n, *session_->scene));
}

void FrameLoop::tellDepth(std::uint64_t n, bool drawn) {
    std::optional<shadow_fit::DepthSpan> all;
    for (const scene::Window* window : session_->windows) {
        if (options_.backend == "none") break;
        all = together(all, orThrow(stationOf(*window).depthSpan(*window, drawn)));
    }
    net::Depth& depth = session_->depth;
    depth = {.n = n, .min = 1.0F, .max = 0.0F};
    if (all) {
        depth.min = static_cast<float>(all->near);
        depth.max = static_cast<float>(all->far);
    }
    host_->send(depth);
    session_->depthKnown = true;
}

void FrameLoop::take(const net::Fit& fit) {
    if (!waiting_ || waiting_->n != fit.n) return;
    const auto since = Clock::now();
    const bool changed = apply(fit.changes) || waitingChanged_;
    const net::Frame frame = *std::exchange(waiting_, std::nullopt);
    sendDigests(frame);
    renderFrame(frame.n, frame.time, frame.capture, changed, since);
}

void FrameLoop::renderFrame(std::uint64_t n, double time, bool capture, bool changed,
                            Clock::time_point since, bool tellsDepth) {
    net::Ready ready{.n = n, .shownFrame = shownFrame_, .shownAt = shownAt_};
    const auto applied = Clock::now();
    ready.stats.applyMs = static_cast<float>(milliseconds(applied - since));
    const bool animates = std::any_of(stations_.begin(), stations_.end(),
                                      [](const auto& entry) { return entry.second->animates(); });
    // A still scene is drawn once.
    const bool draw = options_.backend != "none" && (changed || animates || !session_->drawn);
    for (const scene::Window* window : session_->windows) {
        if (options_.backend == "none") break;
        Station& at = stationOf(*window);
        if (draw) {
            auto drawn = at.draw(*window, time);
            if (!drawn) throw Failure{std::move(drawn).error()};
            ready.stats.triangles += drawn->triangles + drawn->shadowTriangles;
            ready.stats.drawCalls += static_cast<std::uint32_t>(drawn->chunks);
            ready.stats.pagesDrawn += static_cast<std::uint32_t>(drawn->pagesDrawn);
            ready.stats.pagesKept += static_cast<std::uint32_t>(drawn->pagesKept);
            ready.stats.pagesUnseen += static_cast<std::uint32_t>(drawn->pagesUnseen);
            ready.stats.chunksCulled += static_cast<std::uint32_t>(drawn->chunksCulled);
            ready.stats.lightsUnseen += static_cast<std::uint32_t>(drawn->lightsUnseen);
            ready.stats.degenerate += static_cast<std::uint32_t>(drawn->degenerate);
            ready.stats.mapTexels += drawn->mapTexels;
            ready.stats.mapBytes += drawn->mapBytes;
        }
        if (capture) {
            auto picture = at.read(*window);
            if (picture.pixels.empty()) continue;
            host_->send(net::Image{.n = n,
                                   .window = window->id().value,
                                   .width = static_cast<std::uint32_t>(picture.width),
                                   .height = static_cast<std::uint32_t>(picture.height),
                                   .channels = 3,
                                   .pixels = std::move(picture.pixels)});
        }
    }
    session_->drawn = true;
    session_->drawnFrame = n;
    session_->depthKnown = session_->depthKnown && !draw;
    if (tellsDepth && session_->depthKnown) {
        session_->depth.n = n;
        host_->send(session_->depth);
    } else if (tellsDepth) {
        tellDepth(n, true);
    }
    ready.stats.catchUp = std::exchange(session_->skipped, 0U);
    ready.stats.renderMs = static_cast<float>(milliseconds(Clock::now() - since));
    host_->send(ready);
}

void FrameLoop::show(std::uint64_t n) {
    if (n != session_->drawnFrame) return;
    for (const scene::Window* window : session_->windows) {
        if (stations_.empty()) break;
        auto shown = stationOf(*window).present(*window);
        if (!shown) throw Failure{std::move(shown).error()};
    }
    shownFrame_ = n;
    shownAt_ = nanosecondsNow();
}

void FrameLoop::sendEvents() {
    for (auto& [gpu, station] : stations_) {
        for (const auto& [window, event] : station->takeEvents())
            host_->send(net::InputEvent{.window = window.value,
                                        .kind = kindOf(event.kind),
                                        .code = event.code,
                                        .action = event.action,
                                        .mods = event.mods,
                                        .x = event.x,
                                        .y = event.y});
    }
}

}  // namespace gnomon::server
