#include "Peer.h"

#include <fmt/format.h>
#include <gnomon/base/Process.h>
#include <gnomon/image/Pgm.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <glm/trigonometric.hpp>

namespace gnomon::client {
namespace {

using std::chrono::steady_clock;
constexpr std::chrono::seconds patience{120};

std::string written(const math::dvec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

/// Reads and writes lines; each wait has an end.
class Talk {
public:
    Talk(Child child, std::string name) : child_{std::move(child)}, name_{std::move(name)} {}

    Result<std::string> line() {
        const auto deadline = steady_clock::now() + patience;
        for (;;) {
            if (const auto end = text_.find('\n'); end != std::string::npos) {
                std::string found = text_.substr(0, end);
                text_.erase(0, end + 1);
                return found;
            }
            const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
                deadline - steady_clock::now());
            pollfd entry{child_.output(), POLLIN, 0};
            if (left.count() <= 0 || ::poll(&entry, 1, static_cast<int>(left.count())) == 0)
                return fail(Errc::timeout, fmt::format("{} does not answer", name_));
            std::array<char, 4096> buffer{};
            const auto count = ::read(child_.output(), buffer.data(), buffer.size());
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return fail(Errc::process, ended());
            text_.append(buffer.data(), static_cast<std::size_t>(count));
        }
    }
    /// What follows the answer's first word, which is the question's.
    Result<std::string> ask(const std::string& question) {
        const std::string all = question + "\n";
        if (::send(child_.input(), all.data(), all.size(), MSG_NOSIGNAL) !=
            static_cast<ssize_t>(all.size()))
            return fail(Errc::process, ended());
        auto answer = line();
        if (!answer) return answer;
        const auto word = question.substr(0, question.find(' '));
        if (answer->substr(0, answer->find(' ')) != word)
            return fail(Errc::process,
                        fmt::format("{} answers \"{}\" to \"{}\"", name_, *answer, question));
        return answer->substr(std::min(answer->size(), word.size() + 1));
    }

private:
    std::string ended() {
        const int status = child_.wait(steady_clock::now() + std::chrono::seconds{5});
        std::array<char, 512> said{};
        const auto count = ::read(child_.errors(), said.data(), said.size() - 1);
        std::string text{said.data(), static_cast<std::size_t>(std::max<ssize_t>(0, count))};
        text = text.substr(0, text.find('\n'));
        return text.empty() ? fmt::format("{} ended: {}", name_, describeStatus(status)) : text;
    }

    Child child_;
    std::string name_;
    std::string text_ = {};
};

class PeerContender final : public Contender {
public:
    PeerContender(const PeerSetup& setup, Talk talk)
        : setup_{setup}, talk_{std::move(talk)}, factorFile_{setup.triangles} {
        factorFile_ += fmt::format(".{}-{}.pgm", setup.technique, setup.mapSize);
    }
    PeerContender(const PeerContender&) = delete;
    PeerContender& operator=(const PeerContender&) = delete;
    ~PeerContender() override {
        std::error_code ignored;
        std::filesystem::remove(factorFile_, ignored);
    }

    double frame(Motion) override {
        const std::string answer = orThrow(talk_.ask("frame"));
        double ms = 0.0;
        const auto read = std::from_chars(answer.data(), answer.data() + answer.size(), ms);
        if (read.ec != std::errc{} || !(ms > 0.0))
            throw Failure{Errc::process,
                          setup_.program.string() + ": no time in \"" + answer + "\""};
        return ms;
    }
    image::Image factor() override {
        orThrow(talk_.ask("factor " + factorFile_.string()));
        return orThrow(image::readPgm(factorFile_));
    }
    void take(const Step& step) override {
        orThrow(talk_.ask(fmt::format("eye {} {} {}", written(step.look.eye),
                                      written(step.look.center), written(step.look.up))));
        const double c = std::cos(step.turn);
        const double s = std::sin(step.turn);
        const math::dvec3 t = setup_.toward;
        orThrow(talk_.ask("sun " + written({c * t.x + s * t.z, t.y, c * t.z - s * t.x})));
    }
    BenchRow row() const override {
        auto name = setup_.program.stem().string();
        if (name.starts_with("gnomon-")) name.erase(0, 7);
        if (name.ends_with("-peer")) name.erase(name.size() - 5);
        return {
            .technique = name + " " + setup_.technique, .mapSize = setup_.mapSize, .peer = true};
    }

private:
    PeerSetup setup_;
    Talk talk_;
    std::filesystem::path factorFile_;
};

}  // namespace

Result<std::vector<std::string>> peerTechniques(const std::filesystem::path& program) {
    auto child = Child::start({.arguments = {program.string(), "--list"}});
    if (!child) return tl::unexpected{child.error()};
    Talk talk{*std::move(child), program.string()};
    std::vector<std::string> techniques;
    for (auto line = talk.line(); line; line = talk.line()) techniques.push_back(*line);
    if (techniques.empty()) return fail(Errc::process, program.string() + " lists no technique");
    return techniques;
}

Result<std::unique_ptr<Contender>> startPeer(const PeerSetup& setup) {
    const ViewArguments& view = setup.view.view;
    auto child = Child::start(
        {.arguments = {setup.program.string(), setup.triangles.string(), setup.technique,
                       std::to_string(setup.mapSize), std::to_string((*view.size)[0]),
                       std::to_string((*view.size)[1]), fmt::format("{}", glm::degrees(*view.fovy)),
                       fmt::format("{}", *view.near), fmt::format("{}", *view.far)},
         .takesInput = true});
    if (!child) return tl::unexpected{child.error()};
    Talk talk{*std::move(child), setup.program.filename().string()};
    auto ready = talk.line();
    if (!ready) return tl::unexpected{ready.error()};
    if (*ready != "ready")
        return fail(Errc::process, fmt::format("{} says \"{}\", expected \"ready\"",
                                               setup.program.string(), *ready));
    auto peer = std::make_unique<PeerContender>(setup, std::move(talk));
    try {
        peer->take({.look = *view.look()});
    } catch (const Failure& failure) {
        return tl::unexpected{failure.error()};
    }
    return peer;
}

}  // namespace gnomon::client
