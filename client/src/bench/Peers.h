#pragma once

#include <filesystem>

#include "Bench.h"
#include "Judge.h"
#include "Peer.h"

namespace gnomon::client {

/// Which peers take part. What keeps them from it is said once, and the rest goes on.
class Peers {
public:
    /// @param folder  for files they read
    Peers(const PeerOptions& options, std::filesystem::path folder, Console& console);
    /// Those of one view, one for each technique and map size of the chapter.
    std::vector<std::unique_ptr<Contender>> start(const Reference& reference,
                                                  const Chapter& chapter, const Judge& judge,
                                                  const BenchView& view);

private:
    void warnOnce(const std::string& text);

    std::filesystem::path program_;
    std::filesystem::path folder_;
    Console& console_;
    std::vector<std::string> techniques_ = {};  // none: nobody takes part
    std::filesystem::path sceneOf_ = {};        // whose triangles are written
    std::vector<std::string> warned_ = {};
};

}  // namespace gnomon::client
