#include "ViewOptions.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace gnomon::client {
namespace {

constexpr double radians = std::numbers::pi / 180.0;

[[noreturn]] void wrong(const std::string& option, const std::string& text,
                        const std::string& expected) {
    throw CLI::ValidationError{option, fmt::format("found \"{}\", expected {}", text, expected)};
}

std::optional<double> number(std::string_view text) {
    double value = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || read.ec != std::errc{} || read.ptr != text.data() + text.size() ||
        !std::isfinite(value))
        return {};
    return value;
}

std::optional<int> wholeNumber(std::string_view text) {
    int value = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || read.ec != std::errc{} || read.ptr != text.data() + text.size()) return {};
    return value;
}

math::dvec3 vectorAt(const std::vector<double>& numbers, std::size_t first) {
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

math::dvec3 parseVector(const std::string& option, const std::string& text) {
    return vectorAt(parseNumbers(option, text, 3, 3, "three numbers: x,y,z"), 0);
}

math::dvec3 directionAt(const std::string& option, const std::string& text,
                        const std::vector<double>& numbers, std::size_t first) {
    const math::dvec3 direction = vectorAt(numbers, first);
    if (!(glm::length(direction) > 0.0)) wrong(option, text, "a direction that is not 0,0,0");
    return direction;
}

/// A number within (above, atMost].
double parseWithin(const std::string& option, const std::string& text, double above, double below,
                   const std::string& expected) {
    const auto value = number(text);
    if (!value || !(*value > above && *value < below)) wrong(option, text, expected);
    return *value;
}

void addText(CLI::App& command, const std::string& name,
             const std::function<void(const std::string&)>& take, const std::string& help,
             const std::string& form) {
    command.add_option_function<std::string>(name, take, help)->type_name(form);
}

Sun parseSun(const std::string& text) {
    const auto n = parseNumbers("--sun", text, 3, 4,
                                "x,y,z[,ANGLE]: direction toward the light, angular radius in "
                                "degrees");
    const double angle = n.size() > 3 ? n[3] : 0.0;
    if (!(angle >= 0.0 && angle < 90.0))
        wrong("--sun", text, "an angle from 0 to below 90 degrees");
    return {.toward = directionAt("--sun", text, n, 0), .angle = angle * radians};
}

Spot parseSpot(const std::string& text) {
    const auto n = parseNumbers("--spot", text, 7, 8,
                                "px,py,pz,dx,dy,dz,ANGLE[,RADIUS]: position, direction, full cone "
                                "angle in degrees, radius in metres");
    if (!(n[6] > 0.0 && n[6] < 180.0)) wrong("--spot", text, "an angle between 0 and 180 degrees");
    const double radius = n.size() > 7 ? n[7] : 0.0;
    if (!(radius >= 0.0)) wrong("--spot", text, "a radius of 0 or more metres");
    return {.position = vectorAt(n, 0),
            .direction = directionAt("--spot", text, n, 3),
            .angle = n[6] * radians,
            .radius = radius};
}

Point parsePoint(const std::string& text) {
    const auto n =
        parseNumbers("--point", text, 3, 4, "px,py,pz[,RADIUS]: position, radius in metres");
    const double radius = n.size() > 3 ? n[3] : 0.0;
    if (!(radius >= 0.0)) wrong("--point", text, "a radius of 0 or more metres");
    return {.position = vectorAt(n, 0), .radius = radius};
}

}  // namespace

std::vector<double> parseNumbers(const std::string& option, const std::string& text,
                                 std::size_t least, std::size_t most, const std::string& expected) {
    std::vector<double> numbers;
    std::size_t from = 0;
    while (from <= text.size()) {
        const auto end = std::min(text.find(',', from), text.size());
        const auto value = number(std::string_view{text}.substr(from, end - from));
        if (!value) wrong(option, text, expected);
        numbers.push_back(*value);
        from = end + 1;
    }
    if (numbers.size() < least || numbers.size() > most) wrong(option, text, expected);
    return numbers;
}

std::array<int, 2> parseSize(const std::string& option, const std::string& text) {
    constexpr int most = 65535;
    const auto cross = text.find('x');
    if (cross != std::string::npos) {
        const auto width = wholeNumber(std::string_view{text}.substr(0, cross));
        const auto height = wholeNumber(std::string_view{text}.substr(cross + 1));
        if (width && height && *width >= 1 && *height >= 1 && *width <= most && *height <= most)
            return {*width, *height};
    }
    wrong(option, text, fmt::format("WxH in pixels, each 1 to {}", most));
}

std::optional<Look> ViewArguments::look() const {
    if (!eye || !center) return {};
    return Look{.eye = *eye, .center = *center, .up = up.value_or(math::dvec3{0.0, 1.0, 0.0})};
}

void ViewArguments::validate() const {
    if (eye.has_value() != center.has_value())
        throw CLI::ValidationError{eye ? "--eye" : "--center",
                                   "--eye and --center must be given together"};
    if (up && !eye) throw CLI::ValidationError{"--up", "needs --eye and --center"};
    if (eye && *eye == *center)
        throw CLI::ValidationError{"--center", "is the same point as --eye"};
    if (near && far && !(*near < *far))
        throw CLI::ValidationError{
            "--near", fmt::format("is {}, must be less than --far, which is {}", *near, *far)};
}

void addViewOptions(CLI::App& command, ViewArguments& view) {
    const auto huge = std::numeric_limits<double>::infinity();
    addText(
        command, "--size",
        [&view](const std::string& text) { view.size = parseSize("--size", text); },
        "Pixels of the picture", "WxH");
    addText(
        command, "--eye",
        [&view](const std::string& text) { view.eye = parseVector("--eye", text); },
        "Where the eye (on a wall: the head) is in the world, metres", "x,y,z");
    addText(
        command, "--center",
        [&view](const std::string& text) { view.center = parseVector("--center", text); },
        "Where it looks", "x,y,z");
    addText(
        command, "--up",
        [&view](const std::string& text) {
            const auto n = parseNumbers("--up", text, 3, 3, "three numbers: x,y,z");
            view.up = directionAt("--up", text, n, 0);
        },
        "Which way is up (0,1,0)", "x,y,z");
    addText(
        command, "--fovy",
        [&view](const std::string& text) {
            view.fovy =
                parseWithin("--fovy", text, 0.0, 180.0, "degrees above 0 and below 180") * radians;
        },
        "Vertical field of view, degrees", "DEG");
    addText(
        command, "--near",
        [&view, huge](const std::string& text) {
            view.near = parseWithin("--near", text, 0.0, huge, "metres above 0");
        },
        "Nearest depth drawn, metres", "M");
    addText(
        command, "--far",
        [&view, huge](const std::string& text) {
            view.far = parseWithin("--far", text, 0.0, huge, "metres above 0");
        },
        "Farthest depth drawn, metres", "M");
}

void addLightOptions(CLI::App& command, std::vector<LightOption>& lights) {
    // CLI11 calls back once an option, not once a use, so each takes all its uses.
    using Texts = std::vector<std::string>;
    const auto add = [&](const std::string& name, auto parse, const std::string& help,
                         const std::string& form) {
        command
            .add_option_function<Texts>(
                name,
                [&lights, parse](const Texts& texts) {
                    for (const auto& text : texts) lights.emplace_back(parse(text));
                },
                help)
            ->type_name(form)
            ->expected(1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    };
    add("--sun", parseSun, "Parallel light from a direction; replaces the scene's lights",
        "x,y,z[,ANGLE]");
    add("--spot", parseSpot, "Spot light; replaces the scene's lights",
        "px,py,pz,dx,dy,dz,ANGLE[,RADIUS]");
    add("--point", parsePoint, "Point light; replaces the scene's lights", "px,py,pz[,RADIUS]");
}

void ShadowArguments::apply(config::Shadow& shadow) const {
    if (technique) {
        shadow.technique = *technique;
        shadow.on = true;
    }
    if (mapSize) shadow.mapSize = *mapSize;
    if (quality) shadow.qualityMode = true;
    if (depthRange) shadow.depthRange = *depthRange;
    if (frameBudget) shadow.frameBudget = frameBudget;
    if (errorBudget) shadow.errorBudget = errorBudget;
}

void addShadowOptions(CLI::App& command, ShadowArguments& shadow) {
    const auto check = [](const std::string& option, const config::Shadow& candidate) {
        const auto findings = config::validate(candidate);
        if (config::hasError(findings))
            throw CLI::ValidationError{option, config::toError(findings).what};
    };
    addText(
        command, "--technique",
        [&shadow, check](const std::string& text) {
            check("--technique", config::Shadow{.technique = text});
            shadow.technique = text;
        },
        "How shadows are made: FIT[+FILTER], none ...", "T");
    addText(
        command, "--map-size",
        [&shadow, check](const std::string& text) {
            const auto size = wholeNumber(text);
            if (!size) wrong("--map-size", text, "texels a side, a whole number");
            check("--map-size", config::Shadow{.mapSize = *size});
            shadow.mapSize = *size;
        },
        "Texels a side of a shadow map", "N");
    command.add_flag("--quality", shadow.quality, "Better shadows for more time: quality_mode");
    command
        .add_option("--frame-budget", shadow.frameBudget, "Milliseconds a frame that auto keeps to")
        ->type_name("MS")
        ->check(CLI::Range(1e-3, 1e6));
    command.add_option("--error-budget", shadow.errorBudget, "Error that auto keeps to, percent")
        ->type_name("PERCENT")
        ->check(CLI::Range(1e-6, 100.0));
    addText(
        command, "--depth-range",
        [&shadow](const std::string& text) {
            for (const auto use :
                 {config::DepthRange::off, config::DepthRange::previous, config::DepthRange::exact})
                if (text == config::name(use)) shadow.depthRange = use;
            if (!shadow.depthRange || config::name(*shadow.depthRange) != text)
                wrong("--depth-range", text, "off, previous or exact");
        },
        "How fits learn how deep the view is", "USE");
}

void addBackendOption(CLI::App& command, std::string& backend) {
    addText(
        command, "--backend",
        [&backend](const std::string& text) {
            const auto known = {"egl", "osmesa", "glfw", "none", "auto"};
            if (std::find(known.begin(), known.end(), text) == known.end())
                wrong("--backend", text, "egl, osmesa, glfw, none or auto");
            backend = text;
        },
        "What the servers draw with (auto)", "NAME");
}

}  // namespace gnomon::client
