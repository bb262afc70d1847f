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

std::string imagePath(const Foreground& foreground) {
    // Joining keeps an absolute path as it is.
    const std::filesystem::path file{foreground.origin.table.file};
    return (file.parent_path() / foreground.image).string();
}

}  // namespace gnomon::config
