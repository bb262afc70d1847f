#include <gnomon/config/Load.h>

#include "Schema.h"
#include "Text.h"

namespace gnomon::config {
namespace {

class Writer {
public:
    // Under @p header ("[user]"), which is left out, with its table, if nothing differs.
    template <class T>
    void optionalTable(const char* header, const T& value) {
        const std::string lines = fields(value);
        if (!lines.empty()) text_ += std::string{"\n"} + header + "\n" + lines;
    }

    template <class T>
    void table(const char* header, const T& value) {
        text_ += std::string{"\n"} + header + "\n" + fields(value);
    }

    template <class T>
    void top(const T& value) {
        text_ += fields(value);
    }

    std::string take() { return std::move(text_); }

private:
    template <class T>
    static std::string fields(const T& value) {
        const T defaults = {};
        std::string lines;
        forEachField<T>([&](const auto& field) {
            const auto& member = value.*(field.member);
            const bool isNeeded =
                field.rule.required || field.rule.always || !(member == defaults.*(field.member));
            if (!isNeeded) return;
            lines += std::string{field.key} + " = " + tomlText(member) + "\n";
        });
        return lines;
    }

    std::string text_ = {};
};

}  // namespace

std::string toToml(const Config& config) {
    Writer writer;
    writer.top(config);
    writer.optionalTable("[user]", config.user);
    writer.optionalTable("[sync]", config.sync);
    writer.optionalTable("[cluster]", config.cluster);
    writer.optionalTable("[shadow]", config.shadow);
    writer.optionalTable("[render]", config.render);
    if (config.render.foreground) writer.table("[render.foreground]", *config.render.foreground);
    for (const Screen& screen : config.screens) writer.table("[[screen]]", screen);
    for (const Server& server : config.servers) {
        writer.table("[[server]]", server);
        for (const Window& window : server.windows) {
            writer.table("[[server.window]]", window);
            for (const Viewport& viewport : window.viewports) {
                writer.table("[[server.window.viewport]]", viewport);
            }
        }
    }
    return writer.take();
}

}  // namespace gnomon::config
