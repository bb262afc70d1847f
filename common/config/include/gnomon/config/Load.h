#pragma once

#include <gnomon/base/Error.h>
#include <gnomon/config/Config.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::config {

/// A configuration with all that was found wrong with it, in file order.
/// There is a config exactly if no finding is an error; it may still have warnings.
struct Inspection {
    std::optional<Config> config = {};
    std::vector<Finding> findings = {};
};

/// Reads, expands grids, validates and cross-checks. Never fails otherwise than by findings:
/// any bytes will do. @p filename only names the text in messages.
Inspection inspectConfig(std::string_view text, std::string_view filename);

/// The same for a file. Fails (Errc::file) only if it cannot be read.
Result<Inspection> inspectFile(const std::filesystem::path& path);

/// The configuration, or Errc::config with the first error (and how many more) on one line.
Result<Config> parseConfig(std::string_view text, std::string_view filename);
Result<Config> loadConfig(const std::filesystem::path& path);

/// TOML that reads back as an equal Config. Values that are the default are left out.
std::string toToml(const Config& config);

/// Every key the reader knows, with the tables it is in: "user.head", "server.window.size".
std::vector<std::string> knownKeys();

}  // namespace gnomon::config
