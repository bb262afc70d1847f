// What two processes must agree about before they exchange change lists.
#include "TestTypes.h"

namespace gnomon::field::test {
namespace {

TypeInfo describe(std::string name, std::vector<FieldInfo> fields) {
    TypeInfo info{.name = std::move(name), .fields = std::move(fields)};
    info.id = typeIdOf(info.name);
    return info;
}

std::vector<std::byte> schemaOf(const std::vector<TypeInfo>& types) {
    Writer to;
    to.scalar(static_cast<std::uint32_t>(types.size()));
    for (const TypeInfo& type : types) {
        to.string(type.name);
        to.scalar(static_cast<std::uint32_t>(type.fields.size()));
        for (const FieldInfo& field : type.fields) {
            to.string(field.name);
            to.string(field.layout);
            to.scalar(static_cast<std::uint8_t>(field.multi));
        }
    }
    return to.take();
}

void expectDisagreement(const std::vector<std::byte>& schema, std::vector<std::string> words) {
    TypeRegistry types = itemTypes();
    const auto result = types.agree(schema, "the wall");
    ASSERT_FALSE(result.has_value()) << words.front();
    EXPECT_EQ(result.error().code, Errc::schema);
    words.emplace_back("the wall");
    for (const auto& word : words)
        EXPECT_NE(result.error().what.find(word), std::string::npos) << result.error().what;
}

TEST(Schema, TheSameTypesAgree) {
    TypeRegistry types = itemTypes();
    EXPECT_TRUE(types.agree(itemTypes().schema(), "itself").has_value());
    EXPECT_EQ(types.schema(), itemTypes().schema());
}

TEST(Schema, LeavesOutWhatIsNotReplicated) {
    TypeRegistry only;
    only.add<Note>();
    EXPECT_EQ(only.schema(), schemaOf({}));
}

TEST(Schema, ADisagreementNamesTypeAndField) {
    const TypeInfo ours = Item::describe();
    auto renamed = ours.fields;
    renamed[2].name = "count";
    expectDisagreement(schemaOf({describe("Item", renamed)}),
                       {"\"Item\"", "field 2", "\"count\"", "\"number\""});
    auto retyped = ours.fields;
    retyped[2].layout = "I";
    expectDisagreement(schemaOf({describe("Item", retyped)}),
                       {"\"Item\"", "\"number\" (I)", "(i)"});
    auto multi = ours.fields;
    multi[2].multi = true;
    expectDisagreement(schemaOf({describe("Item", multi)}), {"\"Item\"", "\"number\" (i, multi)"});
    auto longer = ours.fields;
    longer.push_back({.name = "extra", .layout = "f"});
    expectDisagreement(schemaOf({describe("Item", longer)}), {"\"Item\"", "\"extra\""});
    auto shorter = ours.fields;
    shorter.pop_back();
    expectDisagreement(schemaOf({describe("Item", shorter)}), {"\"Item\"", "lacks", "\"blobs\""});
    auto swapped = ours.fields;
    std::swap(swapped[0], swapped[1]);
    expectDisagreement(schemaOf({describe("Item", swapped)}), {"\"Item\"", "field 0"});
}

TEST(Schema, BadOnesAreRefusedWhole) {
    expectDisagreement(schemaOf({describe("New", {{.name = "x", .layout = "q"}})}),
                       {"\"New\"", "\"x\"", "unknown layout \"q\""});
    expectDisagreement(schemaOf({describe("New", {{.name = "x", .layout = ""}})}),
                       {"unknown layout"});
    expectDisagreement(schemaOf({describe("New", {{.name = "x", .layout = "ss"}})}),
                       {"unknown layout"});
    expectDisagreement(
        schemaOf({describe("New", std::vector<FieldInfo>(33, {.name = "x", .layout = "f"}))}),
        {"\"New\"", "more than 32 fields"});
    expectDisagreement(schemaOf({describe("New", {}), describe("New", {})}), {"\"New\"", "twice"});
    auto good = schemaOf({describe("New", {{.name = "x", .layout = "f"}})});
    for (std::size_t length = 0; length < good.size(); ++length)
        expectDisagreement({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(length)},
                           {"malformed"});
    good.push_back(std::byte{0});
    expectDisagreement(good, {"malformed"});

    TypeRegistry types = itemTypes();
    auto retyped = Item::describe().fields;
    retyped[0].layout = "i";
    EXPECT_FALSE(
        types.agree(schemaOf({describe("New", {}), describe("Item", retyped)}), "x").has_value());
    EXPECT_EQ(types.find(typeIdOf("New")), nullptr) << "nothing is taken from a refused schema";
}

TEST(Schema, NamesWithOneHashAreRefused) {
    // FNV-1a is easy to collide on purpose: "costarring" and "liquid" do (32 bits).
    static_assert(typeIdOf("costarring") == typeIdOf("liquid"));
    expectDisagreement(schemaOf({describe("costarring", {}), describe("liquid", {})}),
                       {"\"liquid\""});
    TypeRegistry types;
    EXPECT_TRUE(types.agree(schemaOf({describe("costarring", {})}), "a").has_value());
    EXPECT_FALSE(types.agree(schemaOf({describe("liquid", {})}), "b").has_value());
}

}  // namespace
}  // namespace gnomon::field::test
