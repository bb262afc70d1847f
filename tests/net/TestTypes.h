#pragma once

#include <gnomon/field/Aspect.h>
#include <gnomon/field/FieldContainer.h>

#include <array>
#include <random>
#include <string>
#include <vector>

namespace gnomon::net::test {

/// As many bytes as a scene transform: translation in double, 3x3 in float.
struct Placement {
    std::array<double, 3> offset = {};
    std::array<float, 9> linear = {};
    friend bool operator==(const Placement&, const Placement&) = default;
};

}  // namespace gnomon::net::test

template <>
struct gnomon::field::FieldTraits<gnomon::net::test::Placement> {
    static constexpr std::string_view layout = "dddfffffffff";
    static void write(Writer& to, const net::test::Placement& value) {
        for (const double v : value.offset) to.scalar(v);
        for (const float v : value.linear) to.scalar(v);
    }
    static net::test::Placement read(Reader& from) {
        net::test::Placement value;
        for (double& v : value.offset) v = from.scalar<double>();
        for (float& v : value.linear) v = from.scalar<float>();
        return value;
    }
};

namespace gnomon::net::test {

class Thing final : public field::Container<Thing> {
public:
    static constexpr std::string_view typeName = "Thing";
    field::Field<Placement> place;
    field::Field<field::Payload> data;
    field::MultiField<std::int32_t> numbers;
    field::Field<field::Ref<Thing>> other;
    field::Field<std::string> text;
    static constexpr auto fields() {
        return std::tuple{field::entry("place", &Thing::place), field::entry("data", &Thing::data),
                          field::entry("numbers", &Thing::numbers),
                          field::entry("other", &Thing::other), field::entry("text", &Thing::text)};
    }
};

/// Written by the hub's hooks, as ShadowState is.
class Derived final : public field::Container<Derived> {
public:
    static constexpr std::string_view typeName = "Derived";
    field::Field<std::uint64_t> frame;
    field::Field<float> nearest;
    static constexpr auto fields() {
        return std::tuple{field::entry("frame", &Derived::frame),
                          field::entry("nearest", &Derived::nearest)};
    }
};

inline field::TypeRegistry testTypes() {
    field::TypeRegistry types;
    types.add<Thing>();
    types.add<Derived>();
    return types;
}

inline field::Payload randomPayload(std::mt19937& random, std::size_t bytes) {
    std::vector<std::byte> data(bytes);
    for (auto& b : data) b = static_cast<std::byte>(random());
    return field::Payload{std::move(data)};
}

/// An application's side: an aspect that is edited at random.
class Editor {
public:
    explicit Editor(const field::TypeRegistry& types, unsigned seed = 1)
        : random_{seed}, aspect_{types, 2} {}

    field::Aspect& aspect() { return aspect_; }
    std::mt19937& random() { return random_; }

    /// Some creations, changes (payloads among them) and destructions.
    field::ChangeList edits(int count) {
        for (int i = 0; i < count; ++i) editOne();
        return aspect_.commit();
    }
    /// One transform moves.
    field::ChangeList moveOne() {
        if (things_.empty()) things_.push_back(&aspect_.create<Thing>());
        place(*things_.front());
        return aspect_.commit();
    }

private:
    std::size_t below(std::size_t bound) { return random_() % bound; }
    void place(const Thing& thing) {
        Placement placement;
        for (double& v : placement.offset) v = static_cast<double>(random_());
        field::edit(thing)->place = placement;
    }
    void editOne() {
        const std::size_t what = things_.size() < 4 ? 0 : below(6);
        if (what == 0) {
            things_.push_back(&aspect_.create<Thing>());
            return;
        }
        const std::size_t at = below(things_.size());
        const Thing& thing = *things_[at];
        switch (what) {
            case 1:
                place(thing);
                break;
            case 2:
                field::edit(thing)->numbers.pushBack(static_cast<std::int32_t>(random_()));
                break;
            // Few different contents, so that payloads are shared, dropped and come back.
            case 3: {
                std::mt19937 content{static_cast<unsigned>(below(6))};
                field::edit(thing)->data = randomPayload(content, 1000 + 200'000 * below(2));
                break;
            }
            case 4:
                field::edit(thing)->data = field::Payload{};
                break;
            default:
                if (aspect_.destroy(thing))
                    things_.erase(things_.begin() + static_cast<std::ptrdiff_t>(at));
        }
    }

    std::mt19937 random_;
    field::Aspect aspect_;
    std::vector<const Thing*> things_;
};

}  // namespace gnomon::net::test
