#include "TestServer.h"

#include <algorithm>

namespace gnomon::net::test {

SharedKey testKey(char digit) {
    return std::make_shared<const ClusterKey>(
        orThrow(ClusterKey::parse("gnomon-key-1 " + std::string(64, digit))));
}

TestServer::TestServer(std::string name, TestServerOptions options)
    : name_{std::move(name)}, options_{std::move(options)} {
    if (options_.types)
        options_.types(types_);
    else
        types_ = testTypes();
    ServerOptions made{.port = options_.port,
                       .name = name_,
                       .description = "test server",
                       .exitWithClient = options_.exitWithClient,
                       .key = options_.key,
                       .handshakeTimeout = options_.handshakeTimeout,
                       .announce = options_.announce};
    made.turnedAway = [this](const std::string& why) {
        {
            const std::lock_guard lock{mutex_};
            turnedAway_.push_back(why);
        }
        changed_.notify_all();
    };
    host_ = std::make_unique<ServerHost>(std::move(made), types_);
    thread_ = std::thread{[this] { run(); }};
}

TestServer::~TestServer() { kill(); }

void TestServer::kill() {
    if (!thread_.joinable()) return;
    release();
    host_->quit();
    thread_.join();
    host_.reset();
}

void TestServer::stallAt(std::uint64_t frame) {
    {
        const std::lock_guard lock{mutex_};
        stallAt_ = frame;
    }
    changed_.notify_all();
}

void TestServer::release() {
    {
        const std::lock_guard lock{mutex_};
        stallAt_ = ~std::uint64_t{0};
    }
    changed_.notify_all();
}

Seen TestServer::seen() const {
    const std::lock_guard lock{mutex_};
    return seen_;
}

bool TestServer::waitUntil(const std::function<bool(const Seen&)>& predicate) const {
    std::unique_lock lock{mutex_};
    return changed_.wait_until(lock, eventually(), [&] { return predicate(seen_); });
}

bool TestServer::turnedAway(const std::string& why) const {
    std::unique_lock lock{mutex_};
    return changed_.wait_until(lock, eventually(), [&] {
        return std::any_of(turnedAway_.begin(), turnedAway_.end(), [&](const std::string& text) {
            return text.find(why) != std::string::npos;
        });
    });
}

void TestServer::send(const InputEvent& event) {
    const std::lock_guard lock{mutex_};
    toSend_.push_back(event);
}

template <class Fn>
void TestServer::note(Fn&& fn) {
    {
        const std::lock_guard lock{mutex_};
        fn(seen_);
    }
    changed_.notify_all();
}

void TestServer::run() {
    aspect_ = std::make_unique<field::Aspect>(types_, 0);
    while (!seen().quit) {
        ServerEvent event = host_->next(in(20ms));
        {
            const std::lock_guard lock{mutex_};
            for (const InputEvent& input : toSend_) host_->send(input);
            toSend_.clear();
        }
        handle(std::move(event));
    }
}

bool TestServer::apply(const field::ChangeList& changes) {
    const auto applied = aspect_->apply(changes);
    if (!applied) note([&](Seen& s) { s.error = applied.error().what; });
    return applied.has_value();
}

void TestServer::finish(std::uint64_t n) {
    {
        std::unique_lock lock{mutex_};
        changed_.wait(lock, [&] { return n < stallAt_; });
    }
    host_->send(Ready{.n = n, .shownFrame = shownFrame_, .shownAt = shownAt_});
}

void TestServer::tellDepth(std::uint64_t n) {
    const float near = static_cast<float>(name_.size());
    host_->send(Depth{.n = n, .min = near, .max = 10 * near});
}

void TestServer::handle(ServerEvent event) {
    if (std::holds_alternative<Quit>(event)) note([](Seen& s) { s.quit = true; });
    if (std::holds_alternative<ClientJoined>(event)) note([](Seen& s) { ++s.joined; });
    if (const auto* left = std::get_if<ClientLeft>(&event))
        note([&](Seen& s) { s.left.push_back(left->why); });
    if (const auto* swap = std::get_if<Swap>(&event)) {
        shownFrame_ = swap->n;
        shownAt_ = std::chrono::duration_cast<std::chrono::nanoseconds>(
                       SteadyClock::now().time_since_epoch())
                       .count();
        note([&](Seen& s) { s.swaps.push_back(swap->n); });
    }
    if (const auto* snapshot = std::get_if<Snapshot>(&event)) {
        aspect_ = std::make_unique<field::Aspect>(types_, 0);
        if (!apply(snapshot->changes)) return;
        const auto digest = aspect_->digest();
        note([&](Seen& s) {
            s.snapshots.push_back(snapshot->n);
            s.digests[snapshot->n] = digest;
        });
        finish(snapshot->n);
    }
    const auto complete = [this](const Frame& frame) {
        const auto digest = aspect_->digest();
        note([&](Seen& s) {
            s.frames.push_back(frame.n);
            s.digests[frame.n] = digest;
        });
        if (frame.digest)
            host_->send(Digest{.n = frame.n, .digest = digest + (options_.lieAboutDigest ? 1 : 0)});
        if (frame.digests) {
            Digests all = digestsOf(frame.n, *aspect_);
            if (options_.lieAboutDigest) ++all.list.front().digest;
            host_->send(all);
        }
        for (int i = 0; frame.capture && i < options_.images; ++i) {
            Image image{.n = frame.n,
                        .window = static_cast<std::uint64_t>(i),
                        .x = 5,
                        .width = 700,
                        .height = 400,
                        .channels = 3};
            image.pixels.assign(std::size_t{700} * 400 * 3, static_cast<std::uint8_t>(frame.n + 1));
            host_->send(std::move(image));
        }
        if (frame.tellsDepth) tellDepth(frame.n);
        finish(frame.n);
    };
    if (auto* frame = std::get_if<Frame>(&event)) {
        if (!apply(frame->changes)) return;
        if (frame->wantsDepth) {
            tellDepth(frame->n);
            awaitingFit_ = std::move(*frame);
        } else {
            complete(*frame);
        }
    }
    if (const auto* fit = std::get_if<Fit>(&event)) {
        if (!apply(fit->changes)) return;
        if (awaitingFit_ && awaitingFit_->n == fit->n) complete(*std::exchange(awaitingFit_, {}));
    }
}

TestHub::TestHub(SyncOptions options, HubHooks hooks, const SharedKey& key) {
    hooks.log = [lines = lines_](LogLevel, const std::string& text) {
        const std::lock_guard lock{lines->mutex};
        lines->lines.push_back(text);
    };
    hub_ = std::make_unique<ClientHub>(types_, options, std::move(hooks), key);
}

std::vector<std::string> TestHub::log() const {
    const std::lock_guard lock{lines_->mutex};
    return lines_->lines;
}

bool TestHub::logContains(const std::string& text) const {
    const auto lines = log();
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
        return line.find(text) != std::string::npos;
    });
}

}  // namespace gnomon::net::test
