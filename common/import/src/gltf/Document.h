#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gltf/Json.h"
#include "input/Files.h"

namespace gnomon::importer {

/// A glTF 2.0 file's JSON and binary chunk, apart.
struct GltfContainer {
    std::shared_ptr<const nlohmann::json> json = {};  ///< never null
    std::optional<std::span<const std::byte>> binary = {};
};

/// Splits a .glb, or parses a .gltf; refuses other versions than 2.
GltfContainer gltfContainer(std::span<const std::byte> file);

struct BufferView {
    std::span<const std::byte> bytes = {};
    std::size_t stride = 0;  ///< 0: tightly packed
};

/// Parts of a glTF file that others refer to by number, checked once.
class GltfDocument {
public:
    /// @param file  must outlive the document; side files are read from @p folder
    GltfDocument(std::span<const std::byte> file, Folder& folder);
    GltfDocument(const GltfDocument&) = delete;  // its views point into it
    GltfDocument& operator=(const GltfDocument&) = delete;

    const JsonView& root() const noexcept { return root_; }
    Folder& folder() const noexcept { return folder_; }
    const std::vector<JsonView>& accessors() const noexcept { return accessors_; }
    const std::vector<JsonView>& meshes() const noexcept { return meshes_; }
    const std::vector<JsonView>& nodes() const noexcept { return nodes_; }
    const std::vector<BufferView>& views() const noexcept { return views_; }

private:
    void checkVersion() const;
    void checkExtensions() const;
    void readBuffers();
    void readViews();

    Folder& folder_;
    GltfContainer container_;
    JsonView root_;
    std::vector<JsonView> accessors_, meshes_, nodes_;
    std::vector<std::shared_ptr<const Bytes>> owners_;
    std::vector<std::span<const std::byte>> buffers_;
    std::vector<BufferView> views_;
};

}  // namespace gnomon::importer
