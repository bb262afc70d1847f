#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace gnomon::image {

/// A fixture with an empty folder that goes away with the test.
class TemporaryFolder : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern =
            (std::filesystem::temp_directory_path() / "gnomon-image-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override {
        if (!folder_.empty()) std::filesystem::remove_all(folder_);
    }

    std::filesystem::path path(const std::string& name) const { return folder_ / name; }

    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream{path(name), std::ios::binary} << bytes;
        return path(name);
    }
    static std::string read(const std::filesystem::path& from) {
        std::ifstream file{from, std::ios::binary};
        return {std::istreambuf_iterator<char>{file}, {}};
    }
    /// Names in the folder: shows what an unfinished write left behind.
    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (const auto& entry : std::filesystem::directory_iterator{folder_})
            found.push_back(entry.path().filename());
        return found;
    }

private:
    std::filesystem::path folder_;
};

}  // namespace gnomon::image
