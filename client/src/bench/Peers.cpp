#include "Peers.h"

#include <fmt/format.h>
#include <gnomon/base/Process.h>

#include <algorithm>
#include <set>

#include "PeerScene.h"

namespace gnomon::client {
namespace {

/// Of OpenSceneGraph: the plain one, and the two that come closest to the truth.
const std::vector<std::string> usual{"Standard", "LispDB", "ViewDependent"};

}  // namespace

Peers::Peers(const PeerOptions& options, std::filesystem::path folder, Console& console)
    : program_{options.program}, folder_{std::move(folder)}, console_{console} {
    if (options.off) return;
    if (program_.empty()) {
        program_ = programFolder() / "gnomon-osg-peer";
        if (!std::filesystem::exists(program_)) return;
    }
    const auto known = peerTechniques(program_);
    if (!known) {
        warnOnce(known.error().text() + "; going on without peers");
        return;
    }
    const auto& wanted = options.techniques.empty() ? usual : options.techniques;
    for (const auto& technique : wanted) {
        if (std::find(known->begin(), known->end(), technique) != known->end())
            techniques_.push_back(technique);
        else if (!options.techniques.empty())
            throw Failure{
                Errc::config,
                fmt::format("--peer-technique: {} has no \"{}\", expected one of: {}",
                            program_.filename().string(), technique, fmt::join(*known, " "))};
    }
    if (techniques_.empty()) techniques_ = *known;
}

void Peers::warnOnce(const std::string& text) {
    if (std::find(warned_.begin(), warned_.end(), text) != warned_.end()) return;
    warned_.push_back(text);
    console_.log(LogLevel::warning, text);
}

std::vector<std::unique_ptr<Contender>> Peers::start(const Reference& reference,
                                                     const Chapter& chapter, const Judge& judge,
                                                     const BenchView& view) {
    std::vector<std::unique_ptr<Contender>> started;
    if (techniques_.empty()) return started;
    const auto sun = judge.onlySun();
    if (!sun) {
        warnOnce("peers know one sun alone: they are left out of views with other lights");
        return started;
    }
    const auto triangles = folder_ / "peer-scene.bin";
    if (sceneOf_ != reference.file()) writePeerScene(triangles, reference.flat());
    sceneOf_ = reference.file();
    std::set<int> sizes;
    for (const Variant& variant : chapter.variants) sizes.insert(variant.mapSize());
    for (const int size : sizes) {
        for (const auto& technique : techniques_) {
            auto peer = startPeer({.program = program_,
                                   .triangles = triangles,
                                   .technique = technique,
                                   .mapSize = size,
                                   .view = view,
                                   .toward = *sun});
            if (peer)
                started.push_back(*std::move(peer));
            else
                warnOnce(fmt::format("{}; going on without it", peer.error().text()));
        }
    }
    return started;
}

}  // namespace gnomon::client
