#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/client/Look.h>

#include <filesystem>
#include <string_view>
#include <vector>

namespace gnomon::client {

/// A way through the world: JSON lines `{"time": s, "eye": [x,y,z], "center": [x,y,z],
/// "up": [x,y,z]}`, times ascending; up may be left out (y), other keys are passed over.
class CameraPath {
public:
    /// Errors (Errc::file) name file and line.
    static Result<CameraPath> load(const std::filesystem::path& file);
    static Result<CameraPath> parse(std::string_view text, std::string_view filename);

    double start() const noexcept { return keys_.front().time; }
    double end() const noexcept { return keys_.back().time; }
    /// Linear between keys; before the first and after the last one theirs.
    Look at(double time) const noexcept;

private:
    struct Key {
        double time = 0.0;  ///< seconds
        Look look = {};
    };
    std::vector<Key> keys_ = {};  // never empty
};

}  // namespace gnomon::client
