#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "Grid.h"
#include "Rule.h"

/// Every key once: its name, its member, its rule. Reading, checking, writing and the list of
/// known keys all come from here.
namespace gnomon::config {

template <class Owner, class Value>
struct Field {
    std::string_view key = {};
    Value Owner::*member = nullptr;
    Rule rule = {};
};
template <class Owner, class Value>
Field(std::string_view, Value Owner::*, Rule) -> Field<Owner, Value>;

/// `path`: the tables a key of T is in. `nested`: the tables inside T. `fields`: the rest.
template <class T>
struct Schema;

template <class T, class Function>
void forEachField(Function&& function) {
    std::apply([&](const auto&... field) { (function(field), ...); }, Schema<T>::fields);
}

// A room larger than this is a mistake in the unit.
inline constexpr double farAway = 1e5;  // metres
inline constexpr int maxTexture = 16384;
inline constexpr Rule anything = {};
inline constexpr Rule point = {.min = -farAway, .max = farAway, .unit = "m"};
inline constexpr Rule corner = {.min = -farAway, .max = farAway, .unit = "m", .required = true};
inline constexpr Rule seconds = {.min = 0, .max = 86400, .openMin = true, .unit = "s"};
inline constexpr Rule share = {.min = 0, .max = 1};
inline constexpr Rule sizeRule = {.min = 1, .max = maxTexture, .unit = "pixels", .required = true};
inline constexpr Rule desktop = {.min = -1e6, .max = 1e6, .unit = "pixels", .always = true};

template <>
struct Schema<User> {
    static constexpr std::string_view path = "user";
    static constexpr std::array<std::string_view, 0> nested = {};
    static constexpr std::tuple fields{
        Field{"head", &User::head, point},
        Field{"forward", &User::forward, Rule{.min = -farAway, .max = farAway}},
        Field{"eye_separation", &User::eyeSeparation, Rule{.min = 0, .unit = "m"}},
    };
};

template <>
struct Schema<Sync> {
    static constexpr std::string_view path = "sync";
    static constexpr std::array<std::string_view, 0> nested = {};
    static constexpr std::tuple fields{
        Field{"timeout", &Sync::timeout, seconds},
        Field{"start_timeout", &Sync::startTimeout, seconds},
        Field{"on_timeout", &Sync::onTimeout, anything},
        Field{"pipeline", &Sync::pipeline, Rule{.min = 0, .max = 2, .unit = "frames"}},
        Field{"swap_group", &Sync::swapGroup, anything},
    };
};

template <>
struct Schema<Cluster> {
    static constexpr std::string_view path = "cluster";
    static constexpr std::array<std::string_view, 0> nested = {};
    static constexpr std::tuple fields{
        Field{"key", &Cluster::key, Rule{.text = titleExpectation}},
        Field{"launch", &Cluster::launch, anything},
        Field{"server", &Cluster::server, Rule{.text = programExpectation}},
        Field{"options", &Cluster::options, Rule{.text = titleExpectation}},
        Field{"lookup", &Cluster::lookup, Rule{.text = groupExpectation}},
        Field{"relay", &Cluster::relay, Rule{.min = 0, .max = 64, .unit = "servers"}},
        Field{"compress", &Cluster::compress, anything},
    };
};

template <>
struct Schema<Shadow> {
    static constexpr std::string_view path = "shadow";
    static constexpr std::array<std::string_view, 0> nested = {};
    static constexpr std::tuple fields{
        Field{"on", &Shadow::on, anything},
        Field{"technique", &Shadow::technique, Rule{.text = techniqueExpectation}},
        Field{"map_size", &Shadow::mapSize, Rule{.min = 16, .max = maxTexture, .unit = "texels"}},
        Field{"color", &Shadow::color, share},
        Field{"offset_bias", &Shadow::offsetBias, Rule{.min = 0, .max = 1e6}},
        Field{"offset_factor", &Shadow::offsetFactor, Rule{.min = 0, .max = 1e6}},
        Field{"range", &Shadow::range,
              Rule{.min = 0, .max = 0.8, .openMin = true, .openMax = true}},
        Field{"cascades", &Shadow::cascades, Rule{.min = 2, .max = 8}},
        Field{"frame_budget", &Shadow::frameBudget,
              Rule{.min = 0, .max = 1e6, .openMin = true, .unit = "ms"}},
        Field{"error_budget", &Shadow::errorBudget,
              Rule{.min = 0, .max = 100, .openMin = true, .unit = "%"}},
        Field{"softness", &Shadow::softness, Rule{.min = 0, .max = 1000, .unit = "m"}},
        Field{"kernel_width", &Shadow::kernelWidth, Rule{.min = 1, .max = 64, .unit = "texels"}},
        Field{"kernel_samples", &Shadow::kernelSamples, Rule{.min = 0, .max = 64}},
        Field{"quality_mode", &Shadow::qualityMode, anything},
        Field{"depth_range", &Shadow::depthRange, anything},
    };
};

template <>
struct Schema<Foreground> {
    static constexpr std::string_view path = "render.foreground";
    static constexpr std::array<std::string_view, 0> nested = {};
    static constexpr std::tuple fields{
        Field{"image", &Foreground::image, Rule{.required = true, .text = titleExpectation}},
        Field{"position", &Foreground::position, Rule{.min = -1, .max = 1}},
        Field{"height", &Foreground::height, Rule{.min = 0, .max = 1, .openMin = true}},
    };
};

template <>
struct Schema<Render> {
    static constexpr std::string_view path = "render";
    static constexpr std::array<std::string_view, 1> nested = {"foreground"};
    static constexpr std::tuple fields{
        Field{"samples", &Render::samples, Rule{.number = samplesExpectation}},
        Field{"background", &Render::background, share},
        Field{"near", &Render::near, Rule{.min = 0, .openMin = true, .unit = "m"}},
        Field{"far", &Render::far, Rule{.min = 0, .openMin = true, .unit = "m"}},
    };
};

template <>
struct Schema<Screen> {
    static constexpr std::string_view path = "screen";
    static constexpr std::array<std::string_view, 0> nested = {};
    static constexpr std::tuple fields{
        Field{"name", &Screen::name, Rule{.required = true, .text = nameExpectation}},
        Field{"lower_left", &Screen::lowerLeft, corner},
        Field{"lower_right", &Screen::lowerRight, corner},
        Field{"upper_left", &Screen::upperLeft, corner},
        Field{"tiles", &Screen::tiles, Rule{.min = 1, .max = 64}},
        Field{"bezel", &Screen::bezel, Rule{.min = 0, .max = farAway, .unit = "m"}},
        Field{"overlap", &Screen::overlap, Rule{.min = 0, .max = maxTexture, .unit = "pixels"}},
    };
};

template <>
struct Schema<Viewport> {
    static constexpr std::string_view path = "server.window.viewport";
    static constexpr std::array<std::string_view, 0> nested = {};
    static constexpr std::tuple fields{
        Field{"screen", &Viewport::screen, Rule{.required = true, .text = nameExpectation}},
        Field{"tile", &Viewport::tile, Rule{.min = 0, .max = 63}},
        Field{"eye", &Viewport::eye, anything},
        Field{"rect", &Viewport::rect,
              Rule{.min = 0, .max = maxTexture, .number = rectExpectation}},
    };
};

template <>
struct Schema<Window> {
    static constexpr std::string_view path = "server.window";
    static constexpr std::array<std::string_view, 1> nested = {"viewport"};
    static constexpr std::tuple fields{
        Field{"size", &Window::size, sizeRule},
        Field{"position", &Window::position, desktop},
        Field{"fullscreen", &Window::fullscreen, anything},
        Field{"monitor", &Window::monitor, Rule{.min = 0, .max = 63}},
        Field{"gpu", &Window::gpu, Rule{.min = -1, .max = 63}},
    };
};

template <>
struct Schema<Server> {
    static constexpr std::string_view path = "server";
    static constexpr std::array<std::string_view, 1> nested = {"window"};
    static constexpr std::tuple fields{
        Field{"name", &Server::name, Rule{.required = true, .text = nameExpectation}},
        Field{"host", &Server::host, Rule{.always = true, .text = hostExpectation}},
        Field{"port", &Server::port, Rule{.min = 0, .max = 65535, .always = true}},
        Field{"gpu", &Server::gpu, Rule{.min = -1, .max = 63}},
    };
};

template <>
struct Schema<ServerGrid> {
    static constexpr std::string_view path = "server_grid";
    static constexpr std::array<std::string_view, 0> nested = {};
    static constexpr std::tuple fields{
        Field{"screen", &ServerGrid::screen, Rule{.required = true, .text = nameExpectation}},
        Field{"eyes", &ServerGrid::eyes, anything},
        Field{"name", &ServerGrid::name, Rule{.text = titleExpectation}},
        Field{"host", &ServerGrid::host, Rule{.text = titleExpectation}},
        Field{"port", &ServerGrid::port, Rule{.min = 0, .max = 65535}},
        Field{"gpu", &ServerGrid::gpu, Rule{.min = -1, .max = 63}},
        Field{"window", &ServerGrid::window, sizeRule},
        Field{"position", &ServerGrid::position, desktop},
        Field{"fullscreen", &ServerGrid::fullscreen, anything},
        Field{"monitor", &ServerGrid::monitor, Rule{.min = 0, .max = 63}},
    };
};

template <>
struct Schema<Config> {
    static constexpr std::string_view path = "";
    static constexpr std::array<std::string_view, 8> nested = {
        "user", "sync", "cluster", "shadow", "render", "screen", "server", "server_grid"};
    static constexpr std::tuple fields{
        Field{"name", &Config::name, Rule{.text = titleExpectation}},
    };
};

/// Checks one field of @p value against its rule. @p subject starts the message.
template <class Owner, class Value>
void checkField(const Field<Owner, Value>& field, const Owner& value, const std::string& subject,
                std::vector<Finding>& findings) {
    const Value& member = value.*(field.member);
    const std::string wrong = expectation(field.rule, member);
    if (wrong.empty()) return;
    findings.push_back(
        {.place = value.origin.of(field.key),
         .what = brokenText(subject, field.key, tomlText(member), field.rule.unit, wrong)});
}

template <class T>
void checkFields(const T& value, const std::string& subject, std::vector<Finding>& findings) {
    forEachField<T>([&](const auto& field) { checkField(field, value, subject, findings); });
}

}  // namespace gnomon::config
