#pragma once

#include <gnomon/config/Config.h>

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::config {

/// [[server_grid]]: one server for each tile of a screen and each eye.
struct ServerGrid {
    std::string screen = {};
    std::vector<Eye> eyes = {Eye::mono};
    std::string name = "{screen}-{column}-{row}-{eye}";
    std::string host = "localhost";
    std::vector<int> port = {};  ///< one for all, or one an eye; none: as for a server
    std::vector<int> gpu = {-1};
    Cells window = {0, 0};
    Cells position = {0, 0};
    bool fullscreen = false;
    int monitor = 0;
    Origin origin = {};
};

/// What the words of a pattern stand for.
struct GridCell {
    std::string_view screen = {};
    int column = 0;
    int row = 0;
    int tile = 0;   ///< row * columns + column
    int index = 0;  ///< of the server in its grid: tile * eyes + eye
    Eye eye = Eye::mono;
};

/// Fills in {screen} {column} {row} {tile} {index} {eye} {eye1}; a number may have an offset and
/// a width, {tile+1:02}. Errc::config without a position names the word that is none.
Result<std::string> filledIn(std::string_view pattern, const GridCell& cell);

/// Appends the grid's servers to @p config, whose screens are already read.
void expand(const ServerGrid& grid, Config& config, std::vector<Finding>& findings);

inline constexpr std::size_t maxServers = 1024;

/// Of a server on @p host that says none.
inline int portOf(std::string_view host) { return host.empty() || isLocal(host) ? 0 : defaultPort; }

}  // namespace gnomon::config
