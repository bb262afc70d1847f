// fuzz-seeds FOLDER: writes what the fuzz targets begin with.
#include "Seeds.h"

#include <gnomon/base/Error.h>
#include <gnomon/config/Load.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <set>

namespace gnomon::fuzz {

void Seeds::add(const std::string& target, const std::string& name,
                std::span<const std::byte> bytes) const {
    std::filesystem::create_directories(folder_ / target);
    std::ofstream to{folder_ / target / name, std::ios::binary};
    to.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
    if (!to.flush())
        throw Failure{Errc::file, "cannot write " + (folder_ / target / name).string()};
}

void Seeds::add(const std::string& target, const std::string& name, std::size_t reader,
                std::span<const std::byte> bytes) const {
    std::vector<std::byte> all{static_cast<std::byte>(reader)};
    all.insert(all.end(), bytes.begin(), bytes.end());
    add(target, name, all);
}

void Seeds::dictionary(const std::string& target, const std::vector<std::string>& words) const {
    std::filesystem::create_directories(folder_);
    std::ofstream to{folder_ / (target + ".dict")};
    for (const auto& word : words) {
        to << '"';
        for (const char c : word) to << (c == '"' || c == '\\' ? "\\" : "") << c;
        to << "\"\n";
    }
}

namespace {

void addConfigSeeds(const Seeds& seeds) {
    for (const auto& entry :
         std::filesystem::directory_iterator{std::string{GNOMON_SOURCE_DIR} + "/configs"}) {
        if (entry.path().extension() != ".toml") continue;
        std::ifstream in{entry.path(), std::ios::binary};
        const std::string text{std::istreambuf_iterator<char>{in}, {}};
        seeds.add("config", entry.path().stem().string(), text);
    }
    std::set<std::string> words{"[[", "]]", "inf", "nan", "-0.0", "1e308", "true"};
    for (const auto& key : config::knownKeys()) {
        const auto dot = key.rfind('.');
        words.insert(key.substr(dot + 1) + " = ");
        if (dot == std::string::npos) continue;
        words.insert("[" + key.substr(0, dot) + "]");
        words.insert("[[" + key.substr(0, dot) + "]]");
    }
    seeds.dictionary("config", {words.begin(), words.end()});
}

void addSeeds(const Seeds& seeds) {
    addConfigSeeds(seeds);
    addWireSeeds(seeds);
    addChangeSeeds(seeds);
    addModelSeeds(seeds);
    addTrafficSeeds(seeds);
}

}  // namespace
}  // namespace gnomon::fuzz

int main(int count, char** arguments) {
    if (count != 2) {
        std::fputs("usage: fuzz-seeds FOLDER\n", stderr);
        return 2;
    }
    try {
        gnomon::fuzz::addSeeds(gnomon::fuzz::Seeds{arguments[1]});
        return 0;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "fuzz-seeds: %s\n", failure.what());
        return 1;
    }
}
