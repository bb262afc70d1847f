#include "HostRig.h"

#include <gnomon/scene/Types.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>

#include "Check.h"

// A client may tell a server to connect to others. Nobody is reached from here, nor asked for an
// address: these take the system's place.
extern "C" int connect(int socket, const sockaddr* address, socklen_t length) {
    if (address->sa_family == AF_UNIX)
        return static_cast<int>(::syscall(SYS_connect, socket, address, length));
    errno = ECONNREFUSED;
    return -1;
}
extern "C" int getaddrinfo(const char*, const char*, const addrinfo*, addrinfo**) {
    return EAI_NONAME;
}

namespace gnomon::fuzz {
namespace {

constexpr std::size_t maxNodesToFlatten = 4096;

sockaddr_un addressOf(int socket, socklen_t& length) {
    sockaddr_un address{};
    length = sizeof address;
    require(::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &length) == 0,
            "a listening socket has an address");
    return address;
}

/// Listens at an address that the system picks.
int listener() {
    const int made = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const sockaddr_un any{.sun_family = AF_UNIX, .sun_path = {}};
    require(::bind(made, reinterpret_cast<const sockaddr*>(&any), sizeof(sa_family_t)) == 0 &&
                ::listen(made, 16) == 0,
            "sockets can be made");
    return made;
}

std::unique_ptr<field::TypeRegistry> sceneTypes() {
    auto types = std::make_unique<field::TypeRegistry>();
    scene::addTypes(*types);
    return types;
}

/// Of an earlier rig that learnt no others: they take longer to make than most inputs to play.
std::unique_ptr<field::TypeRegistry> spareTypes;

}  // namespace

HostRig::HostRig(net::SharedKey key)
    : types_{spareTypes ? std::move(spareTypes) : sceneTypes()}, listener_{listener()} {
    net::tcp::acceptor acceptor{io_};
    acceptor.assign(net::tcp::v4(), listener_);
    core_ = std::make_unique<net::HostCore>(
        io_, std::move(acceptor), net::ServerOptions{.name = "fuzzed", .key = std::move(key)},
        inbox_, progress_);
    core_->start();
}

HostRig::~HostRig() {
    core_->stop();
    for (int& socket : sockets_)
        if (socket >= 0) ::close(socket);
    io_.restart();
    io_.poll();
    flat_.reset();
    aspect_.reset();
    if (!strangeTypes_) spareTypes = std::move(types_);
}

void HostRig::send(std::size_t connection, std::span<const std::byte> bytes) {
    int& socket = sockets_[connection];
    if (socket < 0) {
        socklen_t length = 0;
        const auto address = addressOf(listener_, length);
        socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
        require(::connect(socket, reinterpret_cast<const sockaddr*>(&address), length) == 0,
                "the server accepts connections");
        run();
    }
    ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    run();
}

void HostRig::disconnect(std::size_t connection) {
    if (sockets_[connection] < 0) return;
    ::close(std::exchange(sockets_[connection], -1));
    run();
}

void HostRig::run() {
    do {
        io_.restart();
        while (io_.poll() > 0) readAway();
    } while (serve());
}

void HostRig::readAway() {
    std::array<std::byte, 65536> unused;
    for (const int socket : sockets_)
        while (socket >= 0 && ::recv(socket, unused.data(), unused.size(), 0) > 0) {
        }
}

/// As ServerHost::next() and the loop that calls it. False where there was nothing.
bool HostRig::serve() {
    auto item = inbox_.pop();
    if (!item) return false;
    heard_ = true;
    if (auto* offer = std::get_if<net::SchemaOffer>(&*item)) {
        static const auto known = sceneTypes()->schema();
        strangeTypes_ = strangeTypes_ || offer->schema != known;
        auto agreed = types_->agree(offer->schema, offer->who);
        core_->agreed(offer->session, std::move(agreed), types_->schema());
        return true;
    }
    if (inbox_.throttled()) core_->throttle();
    take(std::get<net::ServerEvent>(*std::move(item)));
    return true;
}

void HostRig::take(net::ServerEvent event) {
    if (std::holds_alternative<net::ClientJoined>(event)) {
        flat_.reset();
        aspect_ = std::make_unique<field::Aspect>(*types_, std::uint16_t{0});
        waiting_.reset();
    } else if (std::holds_alternative<net::ClientLeft>(event)) {
        waiting_.reset();
    } else if (const auto* snapshot = std::get_if<net::Snapshot>(&event)) {
        if (apply(snapshot->changes)) answer(snapshot->n, false);
    } else if (auto* frame = std::get_if<net::Frame>(&event)) {
        if (!apply(frame->changes)) return;
        if (frame->digest)
            core_->sendControl(net::Part::of(
                net::packet(net::Digest{.n = frame->n, .digest = aspect_->digest()})));
        if (frame->wantsDepth || frame->tellsDepth)
            core_->sendControl(net::Part::of(net::packet(net::Depth{.n = frame->n})));
        if (frame->wantsDepth)
            waiting_ = std::move(*frame);
        else
            answer(frame->n, frame->capture);
    } else if (const auto* fit = std::get_if<net::Fit>(&event)) {
        if (apply(fit->changes) && waiting_) answer(waiting_->n, waiting_->capture);
        waiting_.reset();
    }
}

bool HostRig::apply(const field::ChangeList& changes) {
    if (!aspect_) return false;
    field::Applied applied;
    if (const auto done = aspect_->apply(changes, &applied); !done) {
        flat_.reset();
        aspect_.reset();  // half changed: not to be used any more
        return false;
    }
    flatten(applied);
    return true;
}

void HostRig::flatten(const field::Applied& applied) {
    if (aspect_->size() > maxNodesToFlatten) return;
    if (!flat_) flat_ = std::make_unique<scene::FlatScene>(*aspect_);
    scene::Ref<scene::Node> root;
    aspect_->forEach([&](const field::FieldContainer& container) {
        const auto* node = aspect_->get(scene::Ref<scene::Node>{container.id()});
        if (node != nullptr && !node->parent() && (!root || container.id() < root.id))
            root = scene::Ref<scene::Node>{*node};
    });
    flat_->update(root, {}, applied);
}

void HostRig::answer(std::uint64_t n, bool capture) {
    if (capture)
        core_->sendImage(std::make_shared<const net::Image>(
            net::Image{.n = n, .width = 2, .height = 1, .pixels = std::vector<std::uint8_t>(6)}));
    progress_.lastFinished = n;
    core_->sendControl(net::Part::of(net::packet(net::Ready{.n = n})));
}

}  // namespace gnomon::fuzz
