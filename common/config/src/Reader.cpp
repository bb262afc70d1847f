#include "Reader.h"

#include <fmt/format.h>
#include <gnomon/config/Adjust.h>
#include <gnomon/config/Load.h>

#include <algorithm>
#include <utility>

#include "Schema.h"
#include "Subject.h"
#include "Text.h"
#include "Values.h"

namespace gnomon::config {
namespace {

template <class T>
std::string tableName() {
    const std::string path{Schema<T>::path};
    return path.empty() ? "at the top of the file" : "in [" + path + "]";
}

class Reader {
public:
    explicit Reader(std::vector<Finding>& findings) : findings_{findings} {}

    Config config(const Node& root) {
        Config config;
        read(root, config, "");
        single(root, config.user, "user");
        single(root, config.sync, "sync");
        single(root, config.cluster, "cluster");
        single(root, config.shadow, "shadow");
        if (const Node* node = table(root, "render")) {
            read(*node, config.render, "render");
            if (const Node* inner = table(*node, "foreground")) {
                read(*inner, config.render.foreground.emplace(), "render.foreground");
            }
        }
        each(root, "screen", [&](const Node& node) {
            read(node, config.screens.emplace_back(), subject("screen", peek(node, "name")));
        });
        each(root, "server", [&](const Node& node) {
            config.servers.push_back(server(node, config.cluster.lookup.has_value()));
        });
        each(root, "server_grid", [&](const Node& node) {
            ServerGrid grid;
            if (!read(node, grid, subject("server_grid of screen", peek(node, "screen")))) return;
            if (config.cluster.lookup && node.find("host") == nullptr) grid.host.clear();
            expand(grid, config, findings_);
        });
        place(config);
        return config;
    }

private:
    void complain(const Place& place, const std::string& subjectText, const std::string& what) {
        findings_.push_back(
            {.place = place, .what = subjectText.empty() ? what : subjectText + ": " + what});
    }

    // Reads and checks the plain keys of one table. False if anything was wrong.
    template <class T>
    bool read(const Node& node, T& value, const std::string& subjectText) {
        const std::size_t before = findings_.size();
        value.origin.table = node.place;
        forEachField<T>([&](const auto& field) {
            const Node* item = node.find(field.key);
            if (item == nullptr) {
                if (field.rule.required) {
                    complain(node.place, subjectText, fmt::format("{} is missing", field.key));
                }
                return;
            }
            value.origin.keys.emplace(field.key, item->place);
            auto member = value.*(field.member);
            if (const std::string wrong = config::read(*item, member); !wrong.empty()) {
                complain(item->place, subjectText,
                         fmt::format("{} is {}, must be {}", field.key, found(*item), wrong));
                return;
            }
            // Only what was read is checked, or one mistake would be told twice.
            value.*(field.member) = std::move(member);
            checkField(field, value, subjectText, findings_);
        });
        unknownKeys<T>(node, subjectText);
        return findings_.size() == before;
    }

    template <class T>
    void unknownKeys(const Node& node, const std::string& subjectText) {
        std::vector<std::string_view> known{Schema<T>::nested.begin(), Schema<T>::nested.end()};
        forEachField<T>([&](const auto& field) { known.push_back(field.key); });
        for (const Node& item : node.items) {
            if (std::find(known.begin(), known.end(), item.key) != known.end()) continue;
            std::string hint = suggestion(item.key, known);
            if (hint.empty()) hint = elsewhere(item.key);
            if (hint.empty()) {
                hint = ", known " + tableName<T>() + ": ";
                for (const std::string_view key : known) {
                    if (key != known.front()) hint += ", ";
                    hint += key;
                }
            }
            complain(item.keyPlace, subjectText,
                     fmt::format("unknown key {}{}", tomlText(item.key), hint));
        }
    }

    // ", it belongs in [user]" if another table has the key
    static std::string elsewhere(std::string_view key) {
        for (const std::string& path : knownKeys()) {
            const std::size_t dot = path.rfind('.');
            if (dot == std::string::npos || path.substr(dot + 1) != key) continue;
            return ", it belongs in [" + path.substr(0, dot) + "]";
        }
        return {};
    }

    template <class T>
    void single(const Node& root, T& value, const char* key) {
        if (const Node* node = table(root, key)) read(*node, value, key);
    }

    // The table of that name; null if there is none, or if it is something else (an error).
    const Node* table(const Node& parent, const char* key) {
        const Node* node = parent.find(key);
        if (node == nullptr || node->kind == Node::Kind::table) return node;
        complain(node->place, "", fmt::format("{} is {}, must be a table", key, found(*node)));
        return nullptr;
    }

    // Calls @p function for each table of the list of that name.
    template <class Function>
    void each(const Node& parent, const char* key, const Function& function) {
        const Node* list = parent.find(key);
        if (list == nullptr) return;
        if (list->kind != Node::Kind::list) {
            complain(list->place, "",
                     fmt::format("{} is {}, must be a list of tables, [[...{}]]", key, found(*list),
                                 key));
            return;
        }
        for (const Node& node : list->items) {
            if (node.kind == Node::Kind::table) {
                function(node);
            } else {
                complain(node.place, "",
                         fmt::format("{} has {}, must be a table", key, found(node)));
            }
        }
    }

    Server server(const Node& node, bool lookup) {
        Server server;
        const std::string serverText = subject("server", peek(node, "name"));
        read(node, server, serverText);
        if (lookup && node.find("host") == nullptr) server.host.clear();
        if (node.find("port") == nullptr) server.port = portOf(server.host);
        each(node, "window", [&](const Node& windowNode) {
            Window& window = server.windows.emplace_back();
            const std::string windowText = serverText + ", window";
            read(windowNode, window, windowText);
            each(windowNode, "viewport", [&](const Node& viewportNode) {
                read(viewportNode, window.viewports.emplace_back(), windowText + ", viewport");
            });
        });
        return server;
    }

    // A name for messages, before its table is read.
    static std::string peek(const Node& node, const char* key) {
        const Node* item = node.find(key);
        return item != nullptr && item->kind == Node::Kind::text ? item->text : std::string{};
    }

    // Windows on this machine that say nothing of their position lie as on the wall.
    void place(Config& config) const {
        if (!findings_.empty()) return;
        const Config laidOut = arranged(config);
        for (std::size_t i = 0; i < config.servers.size(); ++i) {
            Server& server = config.servers[i];
            if (!isLocal(server.host)) continue;
            for (std::size_t j = 0; j < server.windows.size(); ++j) {
                Window& window = server.windows[j];
                if (window.fullscreen || window.origin.keys.contains("position")) continue;
                window.position = laidOut.servers[i].windows[j].position;
            }
        }
    }

    std::vector<Finding>& findings_;
};

template <class T>
void addKeys(std::vector<std::string>& keys) {
    const std::string path{Schema<T>::path};
    forEachField<T>([&](const auto& field) {
        keys.push_back(path.empty() ? std::string{field.key}
                                    : fmt::format("{}.{}", path, field.key));
    });
}

}  // namespace

Config readConfig(const Node& root, std::vector<Finding>& findings) {
    return Reader{findings}.config(root);
}

std::vector<std::string> knownKeys() {
    std::vector<std::string> keys;
    addKeys<Config>(keys);
    addKeys<User>(keys);
    addKeys<Sync>(keys);
    addKeys<Cluster>(keys);
    addKeys<Shadow>(keys);
    addKeys<Render>(keys);
    addKeys<Foreground>(keys);
    addKeys<Screen>(keys);
    addKeys<Server>(keys);
    addKeys<Window>(keys);
    addKeys<Viewport>(keys);
    addKeys<ServerGrid>(keys);
    return keys;
}

}  // namespace gnomon::config
