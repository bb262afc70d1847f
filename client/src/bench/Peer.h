#pragma once

#include <filesystem>
#include <memory>

#include "Contender.h"

/// Other projects' renderers, each in a program of its own that draws a frame when told to.
///
/// `PROGRAM --list` prints the techniques it has, one a line. `PROGRAM TRIANGLES TECHNIQUE MAP_SIZE
/// WIDTH HEIGHT FOVY NEAR FAR` (degrees, metres; the triangles as writePeerScene() writes them)
/// says `ready` once it can draw, and then answers each line of its standard input with one line:
///
/// | line | answer |
/// | --- | --- |
/// | `eye EX EY EZ CX CY CZ UX UY UZ` | `eye` |
/// | `sun X Y Z` toward the light | `sun` |
/// | `frame` | `frame MS`: drawn, whole, in so many milliseconds |
/// | `factor FILE` | `factor`: written as PGM, 255 lit, 0 shadowed |
///
/// When it cannot, it ends with one line on standard error and exit code 1.
namespace gnomon::client {

struct PeerSetup {
    std::filesystem::path program = {};
    std::filesystem::path triangles = {};
    std::string technique = {};
    int mapSize = 1024;
    BenchView view = {};          ///< resolved
    math::dvec3 toward{0, 1, 0};  ///< the sun at rest
};

/// What the program has. Errors (Errc::process): it cannot be run.
Result<std::vector<std::string>> peerTechniques(const std::filesystem::path& program);
/// Errors (Errc::process, timeout): it ended (with what it said), or did not answer.
Result<std::unique_ptr<Contender>> startPeer(const PeerSetup& setup);

}  // namespace gnomon::client
