#include <gnomon/field/Wire.h>
#include <gnomon/net/ClientHub.h>
#include <gnomon/net/ServerHost.h>
#include <gnomon/scene/Geometry.h>
#include <gnomon/scene/Light.h>
#include <gnomon/scene/Node.h>
#include <gnomon/scene/Types.h>

#include <map>
#include <thread>

#include "KnownKey.h"
#include "Payloads.h"
#include "Relay.h"
#include "Seeds.h"

namespace gnomon::fuzz {
namespace {

using namespace std::chrono_literals;
using Pieces = std::vector<Relay::Piece>;

field::TypeRegistry sceneTypes() {
    field::TypeRegistry types;
    scene::addTypes(types);
    return types;
}

/// A server that renders nothing and says everything a server can say.
class Server {
public:
    explicit Server(net::SharedKey key)
        : host_{{.name = "seed", .description = "no rendering", .key = std::move(key)}, types_},
          thread_{[this] { run(); }} {}
    ~Server() {
        host_.quit();
        thread_.join();
    }
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;
    std::uint16_t port() const { return host_.port(); }

private:
    void run() {
        while (true) {
            const auto event = host_.next(std::chrono::steady_clock::now() + 60s);
            if (std::holds_alternative<net::Quit>(event)) return;
            if (std::holds_alternative<net::ClientJoined>(event))
                aspect_ = std::make_unique<field::Aspect>(types_, std::uint16_t{0});
            if (const auto* snapshot = std::get_if<net::Snapshot>(&event)) {
                orThrow(aspect_->apply(snapshot->changes));
                host_.send(net::Ready{.n = snapshot->n});
                host_.send(net::Log{.text = "loaded"});
                host_.send(net::InputEvent{.window = 1, .code = 65, .action = 1});
            }
            if (const auto* frame = std::get_if<net::Frame>(&event)) take(*frame);
            if (const auto* fit = std::get_if<net::Fit>(&event)) {
                orThrow(aspect_->apply(fit->changes));
                host_.send(net::Ready{.n = fit->n});
            }
        }
    }
    void take(const net::Frame& frame) {
        orThrow(aspect_->apply(frame.changes));
        if (frame.digest) host_.send(net::Digest{.n = frame.n, .digest = aspect_->digest()});
        if (frame.wantsDepth || frame.tellsDepth)
            host_.send(net::Depth{.n = frame.n, .min = 1, .max = 10});
        if (frame.wantsDepth) return;  // a Fit follows
        if (frame.capture)
            host_.send(net::Image{.n = frame.n,
                                  .window = 1,
                                  .width = 4,
                                  .height = 2,
                                  .pixels = std::vector<std::uint8_t>(24, 99)});
        host_.send(net::Ready{.n = frame.n});
    }

    field::TypeRegistry types_ = sceneTypes();
    net::ServerHost host_;
    std::unique_ptr<field::Aspect> aspect_;
    std::thread thread_;
};

net::HubHooks hooks() {
    net::HubHooks made;
    made.wantsDepth = [](const field::Aspect&, std::uint64_t n) { return n % 3 == 0; };
    made.tellsDepth = [](const field::Aspect&, std::uint64_t n) { return n % 3 == 1; };
    made.fit = [light = field::Id{}](field::Aspect& session, std::uint64_t, float min,
                                     float) mutable {
        if (!light) light = session.create<scene::PointLight>().id();
        const auto* found = session.get(field::Ref<scene::PointLight>{light});
        if (found != nullptr) field::edit(*found)->range = min;
    };
    return made;
}

/// A short session: frames of all kinds, payloads that come and go, a picture, a goodbye.
Pieces sessionOf(const net::SharedKey& key, net::Compress compress = net::Compress::never) {
    Server server{key};
    Relay relay{server.port()};
    {
        const auto types = sceneTypes();
        const auto payloads = knownPayloads();
        field::Aspect aspect{types, 2};
        net::ClientHub hub{types, {.digestEvery = 2, .compress = compress}, hooks(), key};
        const auto top = scene::makeNode<scene::Transform>(aspect, "top");
        const auto shape = scene::makeNode<scene::Geometry>(aspect, "shape");
        field::edit(top.node)->addChild(shape.node);
        field::edit(shape.core)->positions = payloads[2];
        hub.frame(aspect.commit(), 0);
        hub.connect({.name = "seed", .host = "127.0.0.1", .port = relay.port()});
        orThrow(hub.waitForAll({}, std::chrono::steady_clock::now() + 60s));
        for (int i = 1; i < 8; ++i) {
            field::edit(top.node)->name = "frame " + std::to_string(i);
            field::edit(shape.core)->positions = payloads[static_cast<std::size_t>(2 + i % 3)];
            const auto shown = hub.frame(aspect.commit(), i, i == 5);
            if (i == 5) orThrow(hub.takeImages(shown.n, std::chrono::steady_clock::now() + 60s));
        }
        hub.shutdown();
    }
    return relay.end();
}

/// Messages of one direction, as soon as they are whole: connection, then type and body.
template <class Use>
void forEachMessage(const Pieces& pieces, Use&& use) {
    std::map<std::pair<std::size_t, bool>, std::vector<std::byte>> pending;
    for (const auto& piece : pieces) {
        auto& bytes = pending[{piece.connection, piece.toServer}];
        bytes.insert(bytes.end(), piece.bytes.begin(), piece.bytes.end());
        while (bytes.size() >= 8) {
            const std::size_t whole = 8 + field::Reader{bytes}.scalar<std::uint32_t>();
            if (bytes.size() < whole) break;
            const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(whole);
            use(piece, std::vector<std::byte>{bytes.begin() + 4, end});
            bytes.erase(bytes.begin(), end);
        }
    }
}

}  // namespace

void addTrafficSeeds(const Seeds& seeds) {
    const auto pieces = sessionOf(nullptr);
    Script host, hub, hostBytes;
    forEachMessage(pieces, [&](const Relay::Piece& piece, std::vector<std::byte> message) {
        const auto connection = static_cast<std::uint8_t>(piece.connection);
        const auto type =
            static_cast<net::MessageType>(field::Reader{message}.scalar<std::uint32_t>());
        if (piece.toServer)
            host.push_back({.kind = connection, .bytes = std::move(message)});
        else
            hub.push_back({.kind = connection, .bytes = std::move(message)});
        if (piece.toServer && type == net::MessageType::frame) hub.push_back({.kind = 7});
    });
    for (const auto& piece : pieces)
        if (piece.toServer)
            hostBytes.push_back(
                {.kind = static_cast<std::uint8_t>(piece.connection | 4U), .bytes = piece.bytes});
    seeds.add("host", "session", host);
    seeds.add("host", "session-bytes", hostBytes);
    seeds.add("hub", "session", hub);
    for (const std::size_t steps : {1U, 3U, 6U, 12U}) {  // shorter ones are faster to play with
        seeds.add("host", "begin-" + std::to_string(steps),
                  Script{host.begin(),
                         host.begin() + static_cast<std::ptrdiff_t>(std::min(steps, host.size()))});
        seeds.add("hub", "begin-" + std::to_string(steps),
                  Script{hub.begin(),
                         hub.begin() + static_cast<std::ptrdiff_t>(std::min(steps, hub.size()))});
    }

    Script packed;
    forEachMessage(sessionOf(nullptr, net::Compress::always),
                   [&](const Relay::Piece& piece, std::vector<std::byte> message) {
                       if (piece.toServer)
                           packed.push_back({.kind = static_cast<std::uint8_t>(piece.connection),
                                             .bytes = std::move(message)});
                   });
    seeds.add("host", "session-packed", packed);

    Script stranger;
    for (const auto& piece : sessionOf(knownKey()))
        if (piece.toServer)
            stranger.push_back(
                {.kind = static_cast<std::uint8_t>(piece.connection), .bytes = piece.bytes});
    seeds.add("stranger", "session", stranger);
    seeds.add("stranger", "in-the-clear", hostBytes);

    const std::vector<std::byte> words(20, std::byte{'w'});
    const std::vector<std::byte> long_(50'000, std::byte{'l'});
    const Step toServer{.kind = 0}, toClient{.kind = 1};
    const Script meet{toServer, toClient, toServer};
    seeds.add("tls", "handshake", meet);
    Script talk = meet;
    for (const auto& said : {words, long_, words})
        for (const std::uint8_t who : {std::uint8_t{0}, std::uint8_t{1}}) {
            talk.push_back({.kind = static_cast<std::uint8_t>(6U | who), .bytes = said});
            talk.push_back({.kind = who});
        }
    seeds.add("tls", "talk", talk);
    Script changed = meet;
    changed.push_back({.kind = 6, .bytes = words});
    changed.push_back({.kind = 2, .bytes = {std::byte{9}, std::byte{0}, std::byte{1}}});
    seeds.add("tls", "changed", changed);
    Script different = meet;
    different[0].kind |= 0x80U;
    seeds.add("tls", "different-keys", different);
    for (std::size_t i = 0; i < stranger.size() && i < 6; ++i) {
        Script made{{.kind = 4, .bytes = stranger[i].bytes}, toServer, toClient};
        seeds.add("tls", "made-up-" + std::to_string(i), made);
    }
}

}  // namespace gnomon::fuzz
