// libFuzzer's own mutations know nothing of steps: they would mostly break their lengths. These
// change one step's bytes with libFuzzer's, or repeat, drop and reorder whole steps.
#include <algorithm>
#include <random>

#include "Script.h"

// The names and types are libFuzzer's.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

namespace gnomon::fuzz {
namespace {

constexpr std::size_t longestStep = 65535;

using Random = std::minstd_rand;

void mutateBytes(Step& step, std::size_t room) {
    const auto size = step.bytes.size();
    const auto most = std::min(longestStep, size + room);
    if (most == 0) return;
    step.bytes.resize(most);
    step.bytes.resize(
        LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(step.bytes.data()), size, most));
}

void mutate(Script& script, std::size_t room, Random& random) {
    const auto below = [&](std::size_t bound) { return random() % bound; };
    if (script.empty()) script.emplace_back();
    const std::size_t at = below(script.size());
    const auto place = script.begin() + static_cast<std::ptrdiff_t>(at);
    switch (below(10)) {
        case 0:
            if (script[at].bytes.size() + 3 <= room) script.insert(place, Step{script[at]});
            break;
        case 1:
            if (room >= 3) script.insert(place, Step{.kind = static_cast<std::uint8_t>(random())});
            break;
        case 2:
            script.erase(place);
            break;
        case 3:
            std::swap(script[at], script[below(script.size())]);
            break;
        case 4:
            script[at].kind = static_cast<std::uint8_t>(random());
            break;
        default:
            mutateBytes(script[at], room);
            break;
    }
}

std::size_t store(const Script& script, std::uint8_t* to, std::size_t maxSize) {
    const auto bytes = bytesOf(script);
    const auto size = std::min(bytes.size(), maxSize);
    std::copy_n(bytes.begin(), size, to);
    return size;
}

}  // namespace
}  // namespace gnomon::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t maxSize, unsigned seed) {
    using namespace gnomon::fuzz;
    Script script = parsedScript({data, size});
    Random random{seed};
    for (unsigned i = 0; i <= random() % 3; ++i) {
        const auto used = bytesOf(script).size();
        mutate(script, maxSize - std::min(maxSize, used), random);
    }
    return store(script, data, maxSize);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* first, std::size_t firstSize,
                                                 const std::uint8_t* second, std::size_t secondSize,
                                                 std::uint8_t* out, std::size_t maxSize,
                                                 unsigned seed) {
    using namespace gnomon::fuzz;
    Script script = parsedScript({first, firstSize});
    const Script other = parsedScript({second, secondSize});
    Random random{seed};
    const auto cut = static_cast<std::ptrdiff_t>(random() % (script.size() + 1));
    const auto from = static_cast<std::ptrdiff_t>(random() % (other.size() + 1));
    script.erase(script.begin() + cut, script.end());
    script.insert(script.end(), other.begin() + from, other.end());
    return store(script, out, maxSize);
}
