#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::net {

struct Place {
    std::string host = {};
    std::uint16_t port = 0;
    bool operator==(const Place&) const = default;
};

/// Who answered to a name, and which of them to try next: anybody may answer, so nobody is believed
/// before he has proved himself on a connection. Keeps so many, whatever comes.
class Candidates {
public:
    static constexpr std::size_t most = 16;

    explicit Candidates(std::uint64_t seed) : random_{static_cast<std::uint32_t>(seed)} {}

    /// A new lookup: only who answers again is tried again.
    void begin();
    /// @param instance  of the server; the same one may be at several places
    void add(const Place& place, std::uint64_t instance);
    /// Who answered in this lookup and was not tried yet: who failed least, then who answered
    /// first.
    /// Nobody after so many.
    std::optional<Place> next();
    /// As next(), without trying it. 0: it never failed, or not since it worked.
    std::optional<unsigned> failuresOfNext() const;
    void failed(const Place& place);
    void worked(const Place& place);
    /// Different servers that answered in this lookup: the first two, once.
    std::optional<std::pair<Place, Place>> rivals();
    /// The places in this lookup, one a server, in the order of their answers.
    std::vector<Place> all() const;

private:
    struct One {
        Place place = {};
        std::uint64_t instance = 0;
        unsigned failures = 0;
        bool answered = false;  // in this lookup
        bool tried = false;     // since then
    };
    One* find(const Place& place);
    const One* best() const;

    std::vector<One> list_ = {};  // those of this lookup in the order of their answers
    std::size_t tries_ = 0;       // in this lookup
    bool rivalsTold_ = false;
    std::minstd_rand random_;
};

}  // namespace gnomon::net
