// The file that holds a cluster's secret.
#include <gnomon/net/ClusterKey.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace gnomon::net {
namespace {

class KeyFile : public testing::Test {
protected:
    KeyFile() {
        std::string name = (std::filesystem::temp_directory_path() / "gnomon-key-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw Failure{Errc::file, "cannot make " + name};
        folder = name;
    }
    ~KeyFile() override {
        std::error_code ec;
        std::filesystem::remove_all(folder, ec);
    }
    std::filesystem::path write(const std::string& text, ::mode_t mode = 0600) const {
        const auto file = folder / "cluster.key";
        std::ofstream{file} << text;
        ::chmod(file.c_str(), mode);
        return file;
    }
    std::filesystem::path folder;
};

const std::string good = "gnomon-key-1 " + std::string(64, 'a') + "\n";

TEST_F(KeyFile, ComesBackAsItWasSaved) {
    const auto key = ClusterKey::random();
    const auto file = folder / "new" / "cluster.key";
    ASSERT_TRUE(key.save(file));
    struct stat status {};
    ASSERT_EQ(::stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777U, 0600U);
    const auto loaded = ClusterKey::load(file);
    ASSERT_TRUE(loaded) << loaded.error().what;
    EXPECT_TRUE(std::ranges::equal(loaded->secret(), key.secret()));
    EXPECT_EQ(loaded->fingerprint(), key.fingerprint());
    EXPECT_EQ(key.fingerprint().size(), 16U);
    EXPECT_NE(key.fingerprint(), ClusterKey::random().fingerprint());
}

TEST_F(KeyFile, IsNeverOverwritten) {
    const auto file = write("precious");
    const auto saved = ClusterKey::random().save(file);
    ASSERT_FALSE(saved);
    EXPECT_NE(saved.error().what.find("cluster.key: is there already"), std::string::npos);
    EXPECT_EQ(std::filesystem::file_size(file), 8U);
}

TEST_F(KeyFile, ThatOthersMayReadIsRefused) {
    for (const ::mode_t mode : {0644U, 0640U, 0604U, 0620U, 0601U}) {
        const auto loaded = ClusterKey::load(write(good, mode));
        ASSERT_FALSE(loaded) << mode;
        EXPECT_NE(loaded.error().what.find("others may read"), std::string::npos);
        EXPECT_NE(loaded.error().what.find("chmod 600"), std::string::npos);
    }
    EXPECT_TRUE(ClusterKey::load(write(good, 0400)));
}

TEST_F(KeyFile, ThatIsNoneIsOneClearError) {
    const std::vector<std::string> texts{"",
                                         "\n",
                                         std::string(64, 'a'),
                                         good.substr(0, good.size() - 2),
                                         "gnomon-key-2 " + std::string(64, 'a'),
                                         "gnomon-key-1 " + std::string(63, 'a') + "g",
                                         "gnomon-key-1 " + std::string(64, 'A'),
                                         good + "\n",
                                         good + good,
                                         std::string(100'000, 'x')};
    for (const auto& text : texts) {
        const auto loaded = ClusterKey::load(write(text));
        ASSERT_FALSE(loaded) << text.substr(0, 100);
        EXPECT_NE(loaded.error().what.find("cluster.key: not a cluster key"), std::string::npos);
    }
    EXPECT_NE(ClusterKey::load(folder).error().what.find("not a file"), std::string::npos);
    const auto missing = ClusterKey::load(folder / "none.key");
    EXPECT_EQ(missing.error().cause, std::errc::no_such_file_or_directory);
}

TEST(DefaultKeyFile, FollowsTheEnvironment) {
    const char* config = std::getenv("XDG_CONFIG_HOME");
    const std::string before = config == nullptr ? "" : config;
    ::setenv("XDG_CONFIG_HOME", "/some/where", 1);
    EXPECT_EQ(defaultKeyFile(), "/some/where/gnomon/cluster.key");
    ::setenv("XDG_CONFIG_HOME", "relative", 1);  // counts as not set
    const char* home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') {
        EXPECT_EQ(defaultKeyFile(), std::string{home} + "/.config/gnomon/cluster.key");
    }
    if (config == nullptr)
        ::unsetenv("XDG_CONFIG_HOME");
    else
        ::setenv("XDG_CONFIG_HOME", before.c_str(), 1);
}

}  // namespace
}  // namespace gnomon::net
