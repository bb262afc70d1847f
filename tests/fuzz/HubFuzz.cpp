// A client, and a server that may say anything.
//
// A step's kind, bits 0-2: 0 a message on the control connection, 1 on the bulk connection (type
// and body, with the length that is right); 2, 3 bytes on either; 4, 5 the end of either; 6, 7 the
// application hands over another frame, if the last one is done (7: with pictures).
#include <gnomon/field/Wire.h>
#include <gnomon/scene/Node.h>
#include <gnomon/scene/Types.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "Check.h"
#include "HubCore.h"
#include "Script.h"

namespace gnomon::fuzz {
namespace {

/// Closes without the wait that would use up the ports.
void drop(int socket) {
    if (socket < 0) return;
    const linger none{.l_onoff = 1, .l_linger = 0};
    ::setsockopt(socket, SOL_SOCKET, SO_LINGER, &none, sizeof none);
    ::close(socket);
}

/// Where the client connects to. One for all inputs: a port costs more than a connection.
class Listener {
public:
    Listener() : socket_{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)} {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t length = sizeof address;
        require(::bind(socket_, reinterpret_cast<sockaddr*>(&address), length) == 0 &&
                    ::listen(socket_, 16) == 0 &&
                    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &length) == 0,
                "there is a port");
        port_ = ntohs(address.sin_port);
    }
    std::uint16_t port() const noexcept { return port_; }
    int accept() const noexcept {
        return ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    }

private:
    int socket_ = -1;
    std::uint16_t port_ = 0;
};

const field::TypeRegistry& sceneTypes() {
    static const auto types = [] {
        field::TypeRegistry made;
        scene::addTypes(made);
        return made;
    }();
    return types;
}

class Rig {
public:
    explicit Rig(const Listener& listener)
        : listener_{listener},
          core_{io_, types_, {.digestEvery = 2}, hooks(), nullptr},
          top_{scene::makeNode<scene::Group>(application_, "top").node} {
        handOver(false);
        core_.connect({.name = "fuzzer", .host = "127.0.0.1", .port = listener.port()});
        run();
    }
    ~Rig() {
        core_.stop([] {});
        run();
        for (const int socket : sockets_) drop(socket);
        run();
        for (int left = listener_.accept(); left >= 0; left = listener_.accept()) drop(left);
    }
    Rig(const Rig&) = delete;
    Rig& operator=(const Rig&) = delete;

    void send(std::size_t connection, std::span<const std::byte> bytes) {
        if (connection < sockets_.size() && sockets_[connection] >= 0)
            ::send(sockets_[connection], bytes.data(), bytes.size(), MSG_NOSIGNAL);
        run();
    }
    void disconnect(std::size_t connection) {
        if (connection < sockets_.size()) drop(std::exchange(sockets_[connection], -1));
        run();
    }
    void handOver(bool capture) {
        if (call_ && (!call_->done || call_->error)) return;
        field::edit(top_)->name = "top " + std::to_string(++frames_);
        call_ = std::make_shared<net::FrameCall>();
        call_->list = application_.commit();
        call_->capture = capture;
        core_.handOver(call_);
        run();
    }

private:
    net::HubHooks hooks() {
        net::HubHooks made;
        made.wantsDepth = [](const field::Aspect&, std::uint64_t n) { return n % 3 == 0; };
        made.tellsDepth = [](const field::Aspect&, std::uint64_t n) { return n % 3 == 1; };
        made.fit = [](field::Aspect&, std::uint64_t, float, float) {};
        made.depthSeen = [](std::uint64_t, float, float) {};
        made.log = [](net::LogLevel, const std::string&) {};
        return made;
    }
    void run() {
        do {
            io_.restart();
            while (io_.poll() > 0) {
            }
        } while (look());
    }
    /// Takes in what the client does. False where it does nothing.
    bool look() {
        bool news = false;
        for (int fresh = listener_.accept(); fresh >= 0; fresh = listener_.accept()) {
            // Control, bulk, and what comes after a loss.
            if (sockets_.size() < 16)
                sockets_.push_back(fresh);
            else
                drop(fresh);
            news = true;
        }
        std::array<std::byte, 65536> unused;
        for (const int socket : sockets_)
            while (socket >= 0 && ::recv(socket, unused.data(), unused.size(), 0) > 0) news = true;
        core_.status();
        core_.takeImages(frames_);
        return news;
    }

    const Listener& listener_;
    const field::TypeRegistry& types_ = sceneTypes();
    net::asio::io_context io_{1};
    net::HubCore core_;
    field::Aspect application_{types_, 2};
    const scene::Node& top_;
    std::shared_ptr<net::FrameCall> call_;
    std::uint64_t frames_ = 0;
    std::vector<int> sockets_;
};

}  // namespace
}  // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon;
    static const fuzz::Listener listener;
    fuzz::Rig rig{listener};
    for (const fuzz::Step& step : fuzz::parsedScript({data, size})) {
        const unsigned kind = step.kind & 7U;
        const std::size_t connection = kind & 1U;
        if (kind < 2) {
            if (step.bytes.size() < 4) continue;
            field::Writer to;
            to.scalar(static_cast<std::uint32_t>(step.bytes.size() - 4));
            to.bytes(step.bytes);
            rig.send(connection, to.written());
        } else if (kind < 4) {
            rig.send(connection, step.bytes);
        } else if (kind < 6) {
            rig.disconnect(connection);
        } else {
            rig.handOver(kind == 7);
        }
    }
    return 0;
}
