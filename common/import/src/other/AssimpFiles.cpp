#include "other/AssimpFiles.h"

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <cstring>
#include <memory>

namespace gnomon::importer {
namespace {

class MemoryStream final : public Assimp::IOStream {
public:
    explicit MemoryStream(Bytes bytes) : bytes_{std::move(bytes)} {}

    std::size_t Read(void* to, std::size_t size, std::size_t count) override {
        if (size == 0) return 0;
        const auto whole = std::min(count, (bytes_.size() - at_) / size);
        if (whole > 0) std::memcpy(to, bytes_.data() + at_, whole * size);
        at_ += whole * size;
        return whole;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        std::size_t base = 0;
        if (origin == aiOrigin_CUR) base = at_;
        if (origin == aiOrigin_END) base = bytes_.size();
        // Backward seeks arrive as huge offsets; the sum wraps round to where they mean.
        const std::size_t target = base + offset;
        if (target > bytes_.size()) return aiReturn_FAILURE;
        at_ = target;
        return aiReturn_SUCCESS;
    }
    std::size_t Tell() const override { return at_; }
    std::size_t FileSize() const override { return bytes_.size(); }
    void Flush() override {}

private:
    Bytes bytes_;
    std::size_t at_ = 0;
};

}  // namespace

Result<std::filesystem::path> AssimpFiles::allowed(const char* name) const {
    const std::filesystem::path path{name};
    if (path == model_) return path;
    // Assimp puts the model's folder in front of side files' names.
    const auto parent = model_.parent_path();
    const auto text = path.string();
    auto prefix = parent.string();
    if (!prefix.empty() && prefix.back() != '/') prefix += '/';
    if (!prefix.empty() && text.rfind(prefix, 0) == 0)
        return folder_.locate(std::string_view{text}.substr(prefix.size()));
    return folder_.locate(text);
}

bool AssimpFiles::Exists(const char* name) const {
    const auto path = allowed(name);
    std::error_code ec;
    return path && std::filesystem::is_regular_file(*path, ec);
}

Assimp::IOStream* AssimpFiles::Open(const char* name, const char* mode) {
    if (std::strchr(mode, 'w') != nullptr || std::strchr(mode, 'a') != nullptr) return nullptr;
    const auto path = allowed(name);
    if (!path) return nullptr;
    auto bytes = readRegularFile(*path, maxFileBytes);
    if (!bytes) return nullptr;
    return std::make_unique<MemoryStream>(*std::move(bytes)).release();
}

void AssimpFiles::Close(Assimp::IOStream* stream) {
    const std::unique_ptr<Assimp::IOStream> owner{stream};
}

}  // namespace gnomon::importer
