#pragma once

#include <gnomon/field/Aspect.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::field::test {

enum class Colour { red, green, blue, last = blue };

/// An application-defined type with a field of every kind.
class Item final : public Container<Item> {
public:
    static constexpr std::string_view typeName = "Item";
    Field<bool> on;
    Field<std::uint8_t> level{std::uint8_t{3}};
    Field<std::int32_t> number;
    Field<double> weight{1.5};
    Field<std::string> name;
    Field<Colour> colour;
    Field<Ref<Item>> next;
    Field<Payload> data;
    MultiField<std::int32_t> numbers;
    MultiField<std::string> words;
    MultiField<Ref<Item>> links;
    MultiField<Payload> blobs;
    static constexpr auto fields() {
        return std::tuple{entry("on", &Item::on),           entry("level", &Item::level),
                          entry("number", &Item::number),   entry("weight", &Item::weight),
                          entry("name", &Item::name),       entry("colour", &Item::colour),
                          entry("next", &Item::next),       entry("data", &Item::data),
                          entry("numbers", &Item::numbers), entry("words", &Item::words),
                          entry("links", &Item::links),     entry("blobs", &Item::blobs)};
    }
};

/// Stays in its own process.
class Note final : public Container<Note> {
public:
    static constexpr std::string_view typeName = "Note";
    static constexpr bool replicated = false;
    Field<std::string> text;
    static constexpr auto fields() { return std::tuple{entry("text", &Note::text)}; }
};

inline TypeRegistry itemTypes() {
    TypeRegistry types;
    types.add<Item>();
    types.add<Note>();
    return types;
}

inline Payload payloadOf(std::string_view text) {
    return Payload::of(std::span<const char>{text.data(), text.size()});
}

inline void expectApplied(const Result<void>& result) {
    EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().text());
}

/// Two aspects that should stay equal: one that is edited, one that follows by change lists.
class Pair {
public:
    ChangeList exchange(Applied* applied = nullptr) {
        const ChangeList list = source.commit();
        expectApplied(replica.apply(list, applied));
        return list;
    }
    void expectEqual() {
        EXPECT_EQ(source.digest(), replica.digest());
        EXPECT_EQ(source.size(), replica.size());
    }

    TypeRegistry types = itemTypes();
    Aspect source{types, 1};
    Aspect replica{types, 0};
};

/// Builds a change list by hand, to say what no honest aspect says.
class ListBuilder {
public:
    ListBuilder& header(std::uint32_t creations, std::uint32_t changes, std::uint32_t releases,
                        std::uint8_t version = ChangeList::version) {
        writer_.scalar(version);
        writer_.scalar(creations);
        writer_.scalar(changes);
        writer_.scalar(releases);
        return *this;
    }
    template <class T>
    ListBuilder& creation(Id id) {
        writer_.scalar(typeIdOf(T::typeName));
        writer_.id(id);
        return *this;
    }
    ListBuilder& change(Id id, Mask mask) {
        writer_.id(id);
        writer_.scalar(mask);
        return *this;
    }
    template <class T>
    ListBuilder& scalar(T value) {
        writer_.scalar(value);
        return *this;
    }
    ListBuilder& id(Id value) {
        writer_.id(value);
        return *this;
    }
    ChangeList list() { return {.bytes = writer_.take()}; }

private:
    Writer writer_;
};

}  // namespace gnomon::field::test
