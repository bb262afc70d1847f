// In libFuzzer's place, where the compiler has none: every seed, then seeds that were changed at
// random, until the time is up. Nothing guides it, so that it finds less; what it finds it keeps in
// the same way. Takes the options of libFuzzer that scripts/fuzz gives, as far as it needs them.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
// A target may bring its own, which knows the structure of its inputs.
extern "C" __attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data,
                                                                     std::size_t size,
                                                                     std::size_t maxSize,
                                                                     unsigned seed);

namespace {

using Bytes = std::vector<std::uint8_t>;
using Random = std::minstd_rand;

Random& chance() {
    static Random made{1};
    return made;
}
std::size_t below(std::size_t bound) { return chance()() % bound; }

/// What is tried now, for when it ends the process.
const std::uint8_t* triedData = nullptr;
std::size_t triedSize = 0;
std::string keptAs;

extern "C" void keep(int signal) {
    const int file = ::open(keptAs.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
    const bool kept =
        file >= 0 && ::write(file, triedData, triedSize) == static_cast<ssize_t>(triedSize);
    constexpr std::string_view said = "the input is kept as ";
    if (kept && ::write(2, said.data(), said.size()) > 0 &&
        ::write(2, keptAs.data(), keptAs.size()) > 0 && ::write(2, "\n", 1) > 0)
        ::close(file);
    std::signal(signal, SIG_DFL);
    std::raise(signal == SIGALRM ? SIGABRT : signal);
}

void tryInput(const Bytes& input, unsigned seconds) {
    const Bytes exact{input.begin(), input.end()};  // no room behind it
    triedData = exact.data();
    triedSize = exact.size();
    ::alarm(seconds);
    LLVMFuzzerTestOneInput(exact.data(), exact.size());
    ::alarm(0);
}

Bytes contentOf(const std::filesystem::path& file) {
    std::ifstream in{file, std::ios::binary};
    const std::string text{std::istreambuf_iterator<char>{in}, {}};
    return {text.begin(), text.end()};
}

std::vector<Bytes> inputsOf(const std::vector<std::string>& places) {
    std::vector<Bytes> all;
    for (const std::string& place : places) {
        if (!std::filesystem::is_directory(place)) {
            all.push_back(contentOf(place));
            continue;
        }
        for (const auto& entry : std::filesystem::directory_iterator{place})
            if (entry.is_regular_file()) all.push_back(contentOf(entry.path()));
    }
    return all;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize) {
    if (maxSize == 0) return 0;
    const std::size_t at = below(size + 1);
    switch (below(5)) {
        case 0:
            if (size == maxSize) break;
            std::memmove(data + at + 1, data + at, size - at);
            data[at] = static_cast<std::uint8_t>(chance()());
            return size + 1;
        case 1:
            if (at == size) break;
            std::memmove(data + at, data + at + 1, size - at - 1);
            return size - 1;
        case 2:
            return at;  // cut
        case 3: {       // a number that is out of the ordinary
            constexpr std::uint32_t numbers[] = {0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0x10000};
            const std::uint32_t number = numbers[below(std::size(numbers))];
            if (size - at >= sizeof number) std::memcpy(data + at, &number, sizeof number);
            return size;
        }
        default:
            break;
    }
    if (at < size) data[at] ^= static_cast<std::uint8_t>(1U << below(8));
    return size;
}

int main(int count, char** arguments) {
    double seconds = 0.0;
    std::size_t maxSize = 4096;
    unsigned limit = 20;
    std::string prefix;
    std::vector<std::string> places;
    for (int i = 1; i < count; ++i) {
        const std::string_view word{arguments[i]};
        const auto value = [&](std::string_view name) {
            return word.starts_with(name) ? arguments[i] + name.size() : nullptr;
        };
        if (const char* text = value("-max_total_time="))
            seconds = std::stod(text);
        else if (const char* most = value("-max_len="))
            maxSize = std::stoul(most);
        else if (const char* late = value("-timeout="))
            limit = static_cast<unsigned>(std::stoul(late));
        else if (const char* start = value("-artifact_prefix="))
            prefix = start;
        else if (!word.starts_with("-"))
            places.emplace_back(word);
    }
    keptAs = prefix + "broken";
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGALRM})
        std::signal(signal, keep);

    const auto seeds = inputsOf(places);
    if (seeds.empty()) {
        std::fputs("there are no inputs to begin with\n", stderr);
        return 1;
    }
    unsigned long runs = 0;
    for (const Bytes& seed : seeds) {
        tryInput(seed, limit);
        ++runs;
    }
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < until) {
        Bytes input = seeds[below(seeds.size())];
        std::size_t size = std::min(input.size(), maxSize);
        input.resize(maxSize);
        for (std::size_t i = 0; i <= below(4); ++i)
            size = LLVMFuzzerCustomMutator != nullptr
                       ? LLVMFuzzerCustomMutator(input.data(), size, maxSize,
                                                 static_cast<unsigned>(chance()()))
                       : LLVMFuzzerMutate(input.data(), size, maxSize);
        input.resize(size);
        tryInput(input, limit);
        ++runs;
    }
    std::printf("stat::number_of_executed_units: %lu\n", runs);
    return 0;
}
