// Any text as a wall's description: it is refused with findings, or is a wall that can be written,
// read again, drawn and laid out.
#include <gnomon/config/Adjust.h>
#include <gnomon/config/Layout.h>
#include <gnomon/config/Load.h>
#include <gnomon/config/Report.h>

#include "Check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon;
    const std::string_view text{reinterpret_cast<const char*>(data), size};
    const auto inspected = config::inspectConfig(text, "wall.toml");
    fuzz::require(inspected.config.has_value() != config::hasError(inspected.findings),
                  "there is a wall exactly where there is no error");
    for (const auto& finding : inspected.findings) finding.text();
    if (!inspected.config) return 0;
    const config::Config& wall = *inspected.config;
    const auto again = config::parseConfig(config::toToml(wall), "again.toml");
    fuzz::require(again.has_value() && *again == wall, "what is written reads back as it was");
    config::describe(wall);
    config::svg(wall);
    for (std::size_t i = 0; i < wall.screens.size(); ++i)
        static_cast<void>(config::canvas(wall, i));
    static_cast<void>(config::withTileSize(wall, 64, 48));
    config::describe(config::localized(wall));
    return 0;
}
