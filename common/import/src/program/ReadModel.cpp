#include "program/ReadModel.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "gltf/Gltf.h"
#include "input/Files.h"
#include "obj/Obj.h"
#include "other/Assimp.h"
#include "ply/Ply.h"

namespace gnomon::importer {

void readModel(const std::filesystem::path& file, SceneBuilder& to) {
    auto bytes = readRegularFile(file, maxFileBytes);
    if (!bytes) throw Failure{std::move(bytes).error()};
    Folder folder{file};
    auto extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto begins = [&](const char* text) {
        const auto size = std::strlen(text);
        return bytes->size() >= size && std::memcmp(bytes->data(), text, size) == 0;
    };
    // GLB and PLY say what they are; for the rest there is only the name.
    if (extension == ".gltf" || extension == ".glb" || extension == ".vrm" || begins("glTF"))
        return readGltf(*bytes, folder, to);
    if (extension == ".obj") return readObj(*bytes, folder, to);
    if (extension == ".ply" || begins("ply\n") || begins("ply\r"))
        return readPly(*bytes, folder, to);
    bytes->clear();
    bytes->shrink_to_fit();
    readWithAssimp(file, folder, to);
}

}  // namespace gnomon::importer
