#pragma once

#include <gnomon/field/Aspect.h>
#include <gnomon/scene/Geometry.h>
#include <gnomon/scene/Imported.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "Shapes.h"

namespace gnomon::importer {

/// A folder of this test's own, gone with it.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path write(const std::string& name, std::string_view content) const;

private:
    std::filesystem::path path_;
};

/// Builds glTF files piece by piece.
class GltfWriter {
public:
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};

    /// Appends to the binary chunk; the accessor's number.
    template <class T>
    std::size_t accessor(const std::vector<T>& values, int componentType, const char* type,
                         std::size_t perElement = 1) {
        return accessor(std::as_bytes(std::span{values}), values.size() / perElement, componentType,
                        type);
    }
    std::size_t positions(const std::vector<math::vec3>& values) {
        return accessor(values, 5126, "VEC3");
    }
    std::size_t indices(const std::vector<std::uint32_t>& values) {
        return accessor(values, 5125, "SCALAR");
    }
    /// A mesh of one primitive; its number.
    std::size_t mesh(const Shape& shape);
    std::size_t node(nlohmann::json node);
    /// All nodes given so far are in the scene, if they are no children.
    std::string glb();
    std::string gltf() { return finished().dump(); }

private:
    std::size_t accessor(std::span<const std::byte> bytes, std::size_t count, int componentType,
                         const char* type);
    nlohmann::json finished();
    std::string binary_;
};

/// A model read in this process, through the readers.
class Model {
public:
    /// @param name  decides on the format
    Model(const std::string& name, std::string_view content);
    explicit Model(const std::filesystem::path& file);
    /// What an importer's list makes of a fresh aspect.
    explicit Model(const field::ChangeList& list);

    const field::Aspect& aspect() const { return *aspect_; }
    const scene::ImportedScene& imported() const { return *imported_; }
    std::vector<const scene::Node*> nodesNamed(std::string_view name) const;
    /// The one node of that name.
    const scene::Node& node(std::string_view name) const;
    template <class T>
    const T& core(const scene::Node& node) const {
        const T* found = aspect_->get(field::Ref<T>{node.core.get().id});
        if (found == nullptr) throw std::runtime_error{"the core is of another type"};
        return *found;
    }
    template <class T>
    std::vector<const T*> all() const {
        std::vector<const T*> found;
        aspect_->forEach([&](const field::FieldContainer& c) {
            if (const auto* t = dynamic_cast<const T*>(&c)) found.push_back(t);
        });
        return found;
    }
    /// Whether a warning contains this.
    bool warned(std::string_view text) const;
    std::vector<std::string> warnings() const {
        return {imported_->warnings.begin(), imported_->warnings.end()};
    }

private:
    void adopt(const field::ChangeList& list);
    void load(const std::filesystem::path& file);

    std::unique_ptr<field::TypeRegistry> types_;
    std::unique_ptr<field::Aspect> aspect_;
    const scene::ImportedScene* imported_ = nullptr;
};

/// A payload's GLM vectors, which Payload::as does not take.
template <class T>
std::vector<T> vectors(const field::Field<field::Payload>& field) {
    std::vector<T> out(field->size() / sizeof(T));
    if (!out.empty())
        std::memcpy(static_cast<void*>(out.data()), field->bytes().data(), out.size() * sizeof(T));
    return out;
}

/// What reading it refuses with; empty where it does not.
std::string refusal(const std::string& name, std::string_view content);

/// Checks what Geometry promises: ranges, bounds, chunks that cover all indices, unit normals.
/// Empty where all is well, else what is wrong.
std::string faultsOf(const scene::Geometry& geometry);

/// A PNG of stored (not compressed) rgba pixels. @p claimed: what its header says instead of the
/// size, if not 0.
std::string png(std::uint32_t width, std::uint32_t height, const std::vector<std::uint32_t>& rgba,
                std::uint32_t claimed = 0);

/// A JPEG of two pixels, red and green.
std::string jpeg();

/// Where the development scenes are, or empty.
std::filesystem::path sharedScenes();

}  // namespace gnomon::importer
