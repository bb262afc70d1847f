#include <fcntl.h>
#include <fmt/format.h>
#include <gnomon/net/ClusterKey.h>
#include <openssl/crypto.h>
#include <openssl/rand.h>
#include <openssl/sha.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace gnomon::net {
namespace {

constexpr std::string_view head = "gnomon-key-1 ";
constexpr std::string_view digits = "0123456789abcdef";
constexpr std::size_t textBytes = head.size() + 2 * ClusterKey::bytes + 1;

std::error_code systemError() { return {errno, std::generic_category()}; }

/// Closes a file descriptor.
class Descriptor {
public:
    explicit Descriptor(int fd) : fd_{fd} {}
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const noexcept { return fd_; }

private:
    int fd_;
};

std::string fingerprintOf(std::span<const std::byte, ClusterKey::bytes> secret) {
    constexpr std::string_view purpose = "gnomon cluster key fingerprint";
    std::string text{purpose};
    text.append(reinterpret_cast<const char*>(secret.data()), secret.size());
    std::array<unsigned char, SHA256_DIGEST_LENGTH> hash{};
    SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), hash.data());
    OPENSSL_cleanse(text.data(), text.size());
    std::string result;
    for (std::size_t i = 0; i < 8; ++i) result += fmt::format("{:02x}", hash[i]);
    return result;
}

}  // namespace

ClusterKey::ClusterKey(const std::array<std::byte, bytes>& secret)
    : secret_{secret}, fingerprint_{fingerprintOf(secret_)} {}

ClusterKey::~ClusterKey() { OPENSSL_cleanse(secret_.data(), secret_.size()); }

ClusterKey ClusterKey::random() {
    std::array<std::byte, bytes> secret{};
    if (RAND_priv_bytes(reinterpret_cast<unsigned char*>(secret.data()), bytes) != 1)
        throw Failure{Errc::process, "the system gives no random numbers for a key"};
    return ClusterKey{secret};
}

Result<ClusterKey> ClusterKey::parse(std::string_view text) {
    if (text.ends_with('\n')) text.remove_suffix(1);
    std::array<std::byte, bytes> secret{};
    bool good = text.size() == textBytes - 1 && text.starts_with(head);
    for (std::size_t i = 0; good && i < 2 * bytes; ++i) {
        const auto digit = digits.find(text[head.size() + i]);
        good = digit != std::string_view::npos;
        secret[i / 2] = secret[i / 2] << 4U | static_cast<std::byte>(digit & 15U);
    }
    if (!good) return fail(Errc::file, "not a cluster key, expected a file made by gnomon keygen");
    ClusterKey key{secret};
    OPENSSL_cleanse(secret.data(), secret.size());
    return key;
}

Result<ClusterKey> ClusterKey::load(const std::filesystem::path& file) {
    const auto name = file.string();
    const Descriptor in{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    if (in.get() < 0)
        return fail(Errc::file, name + ": cannot read the cluster key", systemError());
    struct stat status {};
    if (::fstat(in.get(), &status) != 0 || !S_ISREG(status.st_mode))
        return fail(Errc::file, name + ": not a file, expected a cluster key");
    if ((status.st_mode & 077U) != 0)
        return fail(Errc::file,
                    fmt::format("{}: others may read this cluster key (mode {:04o}), expected mode "
                                "0600: run chmod 600",
                                name, status.st_mode & 07777U));
    std::array<char, textBytes + 1> room{};
    std::size_t size = 0;
    while (size < room.size()) {
        const auto got = ::read(in.get(), room.data() + size, room.size() - size);
        if (got < 0) return fail(Errc::file, name + ": cannot read the cluster key", systemError());
        if (got == 0) break;
        size += static_cast<std::size_t>(got);
    }
    auto key = parse({room.data(), size});
    OPENSSL_cleanse(room.data(), room.size());
    if (!key) return fail(Errc::file, name + ": " + key.error().what);
    return key;
}

Result<void> ClusterKey::save(const std::filesystem::path& file) const {
    const auto name = file.string();
    std::error_code ec;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ec);
    if (ec) return fail(Errc::file, name + ": cannot make its folder", ec);
    const Descriptor out{::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600)};
    if (out.get() < 0 && errno == EEXIST)
        return fail(Errc::file, name + ": is there already, a key is never overwritten");
    if (out.get() < 0) return fail(Errc::file, name + ": cannot write the key", systemError());
    std::string text{head};
    text.reserve(textBytes);
    for (const std::byte b : secret_) {
        text += digits[std::to_integer<std::size_t>(b >> 4U)];
        text += digits[std::to_integer<std::size_t>(b & std::byte{15})];
    }
    text += '\n';
    const bool written =
        ::write(out.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
        ::fsync(out.get()) == 0;
    const auto cause = systemError();
    OPENSSL_cleanse(text.data(), text.size());
    if (written) return {};
    ::unlink(file.c_str());  // half a key is none
    return fail(Errc::file, name + ": cannot write the key", cause);
}

std::filesystem::path defaultKeyFile() {
    const auto folder = [](const char* variable) -> std::filesystem::path {
        const char* value = std::getenv(variable);
        if (value == nullptr || *value == '\0') return {};
        return value;
    };
    const auto config = folder("XDG_CONFIG_HOME");
    if (config.is_absolute()) return config / "gnomon" / "cluster.key";
    const auto home = folder("HOME");
    return home.empty() ? home : home / ".config" / "gnomon" / "cluster.key";
}

}  // namespace gnomon::net
