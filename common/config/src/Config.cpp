#include <gnomon/config/Config.h>

#include <filesystem>

#include "Subject.h"
#include "Text.h"

namespace gnomon::config {

std::string_view name(Eye eye) noexcept {
    switch (eye) {
        case Eye::mono:
            return "mono";
        case Eye::left:
            return "left";
        case Eye::right:
            return "right";
    }
    return "?";
}

std::string_view name(DepthRange use) noexcept {
    return use == DepthRange::off ? "off" : use == DepthRange::previous ? "previous" : "exact";
}

std::string_view name(Launch how) noexcept {
    switch (how) {
        case Launch::none:
            return "none";
        case Launch::ssh:
            return "ssh";
        case Launch::slurm:
            return "slurm";
        case Launch::mpi:
            return "mpi";
    }
    return "?";
}

std::string_view name(Compress use) noexcept {
    switch (use) {
        case Compress::automatic:
            return "auto";
        case Compress::never:
            return "never";
        case Compress::always:
            return "always";
    }
    return "?";
}

std::string_view name(OnTimeout action) noexcept {
    return action == OnTimeout::drop ? "drop" : "wait";
}

std::string subject(std::string_view kind, std::string_view name) {
    std::string text{kind};
    return name.empty() ? text : text + " " + tomlText(name);
}

std::optional<std::size_t> screenIndex(const Config& config, std::string_view screenName) {
    for (std::size_t i = 0; i < config.screens.size(); ++i) {
        if (config.screens[i].name == screenName) return i;
    }
    return {};
}

bool isLocal(std::string_view host) {
    if (host == "localhost" || host == "::1") return true;
    return host.starts_with("127.") &&
           host.find_first_not_of("0123456789.") == std::string_view::npos;
}

int gpuOf(const Server& server, const Window& window) { return window.gpu.value_or(server.gpu); }

namespace {

/// What is named in the configuration is looked for beside its file; an absolute path stays.
std::string beside(const Origin& origin, const std::string& name) {
    return (std::filesystem::path{origin.table.file}.parent_path() / name).string();
}

}  // namespace

std::string imagePath(const Foreground& foreground) {
    return beside(foreground.origin, foreground.image);
}

std::string keyPath(const Cluster& cluster) {
    return cluster.key ? beside(cluster.origin, *cluster.key) : std::string{};
}

}  // namespace gnomon::config
