#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::importer {

/// Deepest nesting of objects and arrays that is parsed.
inline constexpr std::size_t maxJsonDepth = 128;

/// Parses after a look at the nesting, so that no recursive code ever meets deep nesting.
/// Refuses (throws) what is no JSON object.
nlohmann::json parsedJson(std::string_view text);

/// A JSON value from a file that may be hostile, and what to call it in errors ("accessor 3"). Each
/// getter checks type and range and refuses by throwing Failure; absent keys are their own matter.
class JsonView {
public:
    JsonView(const nlohmann::json& json, std::string where)
        : json_{&json}, where_{std::move(where)} {}

    const std::string& where() const noexcept { return where_; }
    bool has(const char* key) const;
    /// A member that is an object; nothing where it is absent.
    std::optional<JsonView> object(const char* key) const;
    /// extensions.NAME.
    std::optional<JsonView> extension(const char* name) const;
    /// The items of a member array of objects; named "WHERE: KEY i", or "NAME i" with @p name.
    std::vector<JsonView> objects(const char* key, const char* name = nullptr) const;
    std::size_t arraySize(const char* key) const;

    /// A whole number from 0 up to 2^53.
    std::optional<std::uint64_t> unsignedInteger(const char* key) const;
    std::uint64_t unsignedInteger(const char* key, std::uint64_t otherwise) const {
        return unsignedInteger(key).value_or(otherwise);
    }
    /// The number of one of @p count things.
    std::optional<std::size_t> index(const char* key, std::size_t count, const char* things) const;
    std::vector<std::size_t> indices(const char* key, std::size_t count, const char* things) const;
    std::optional<double> number(const char* key) const;
    double number(const char* key, double otherwise) const {
        return number(key).value_or(otherwise);
    }
    /// Exactly as many numbers as @p to has; false where the key is absent.
    bool numbers(const char* key, std::span<double> to) const;
    std::optional<std::string> string(const char* key) const;
    std::string string(const char* key, std::string_view otherwise) const;
    std::vector<std::string> strings(const char* key) const;
    bool boolean(const char* key, bool otherwise) const;
    /// Names of the members.
    std::vector<std::string> keys() const;

    [[noreturn]] void refuse(const std::string& what) const;

private:
    const nlohmann::json* find(const char* key) const;
    [[noreturn]] void wrong(const char* key, const nlohmann::json& found, const char* wanted) const;

    const nlohmann::json* json_;
    std::string where_;
};

}  // namespace gnomon::importer
