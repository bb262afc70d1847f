#pragma once

#include <assimp/IOSystem.hpp>
#include <filesystem>
#include <string>

#include "input/Files.h"

namespace gnomon::importer {

/// The file system as Assimp sees it: the model, and what lies below its folder. Read only.
class AssimpFiles final : public Assimp::IOSystem {
public:
    AssimpFiles(std::filesystem::path model, Folder& folder)
        : model_{std::move(model)}, folder_{folder} {}

    bool Exists(const char* name) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* name, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;

private:
    Result<std::filesystem::path> allowed(const char* name) const;

    std::filesystem::path model_;
    Folder& folder_;
};

}  // namespace gnomon::importer
