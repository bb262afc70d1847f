#pragma once

#include <gnomon/client/Lights.h>
#include <gnomon/client/Look.h>
#include <gnomon/config/Config.h>

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>
#include <vector>

/// Options that several subcommands share. What does not parse throws CLI::ValidationError, which
/// ends the program with exit code 2 and a line that says what was expected.
namespace gnomon::client {

/// VIEW: `--size WxH --eye x,y,z --center x,y,z [--up x,y,z] --fovy DEG --near --far M`.
struct ViewArguments {
    std::optional<std::array<int, 2>> size = {};  ///< pixels
    std::optional<math::dvec3> eye = {};
    std::optional<math::dvec3> center = {};
    std::optional<math::dvec3> up = {};
    std::optional<double> fovy = {};  ///< radians
    std::optional<double> near = {};
    std::optional<double> far = {};

    /// What eye, center and up say; nothing where they were not given.
    std::optional<Look> look() const;
    /// @throws CLI::ValidationError: eye without center, near beyond far ...
    void validate() const;
};
void addViewOptions(CLI::App& command, ViewArguments& view);

/// `--sun`, `--spot`, `--point`, each any number of times: suns first, then spots, then points.
void addLightOptions(CLI::App& command, std::vector<LightOption>& lights);

/// `--technique T`, `--map-size N`, `--quality`, `--depth-range USE`, checked as a config's are.
struct ShadowArguments {
    std::optional<std::string> technique = {};
    std::optional<int> mapSize = {};
    bool quality = false;
    std::optional<config::DepthRange> depthRange = {};
    std::optional<double> frameBudget = {};  ///< milliseconds
    std::optional<double> errorBudget = {};  ///< percent

    /// Puts what was given in place of the config's.
    void apply(config::Shadow& shadow) const;
};
void addShadowOptions(CLI::App& command, ShadowArguments& shadow);

/// `--backend egl|osmesa|glfw|none|auto`
void addBackendOption(CLI::App& command, std::string& backend);

/// Exactly @p count finite numbers between commas. @param expected  said in the error
std::vector<double> parseNumbers(const std::string& option, const std::string& text,
                                 std::size_t least, std::size_t most, const std::string& expected);
/// `WxH`, each 1 to 65535.
std::array<int, 2> parseSize(const std::string& option, const std::string& text);

}  // namespace gnomon::client
