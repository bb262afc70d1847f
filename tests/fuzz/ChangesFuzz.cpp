// Change lists, applied one after the other to an aspect that knows the scene's types and a few of
// a stranger's.
//
// A step's kind, bits 0-2: 0 a whole list as it is; else one entry of the list that is being made:
// 1 creation (u8 type, u8 id), 2 change (u8 id, u32 mask, fields), 3 release (u8 id), 4 another
// block, 5 the list is applied. What is left at the end is applied, too.
#include <gnomon/field/Aspect.h>
#include <gnomon/scene/FlatScene.h>
#include <gnomon/scene/Types.h>

#include <algorithm>

#include "Check.h"
#include "Payloads.h"
#include "Script.h"
#include "Types.h"

namespace gnomon::fuzz {
namespace {

using field::Writer;

/// Puts entries together, with the counts that are right.
class ListMaker {
public:
    explicit ListMaker(const std::vector<field::TypeId>& types) : types_{types} {}

    void add(const Step& step) {
        field::Reader from{step.bytes};
        switch (step.kind & 7U) {
            case 1:
                creations_.scalar(types_[from.scalar<std::uint8_t>() % types_.size()]);
                creations_.id(id(from));
                ++created_;
                break;
            case 2:
                changes_.id(id(from));
                changes_.bytes(from.bytes(from.remaining()));
                ++changed_;
                break;
            case 3:
                releases_.id(id(from));
                ++released_;
                break;
            default:
                endBlock();
                break;
        }
    }
    std::vector<std::byte> take() {
        endBlock();
        return list_.take();
    }

private:
    static field::Id id(field::Reader& from) {
        return field::Id::make(2, from.scalar<std::uint8_t>());
    }
    void endBlock() {
        if (created_ + changed_ + released_ == 0) return;
        list_.scalar(field::ChangeList::version);
        for (std::uint32_t* count : {&created_, &changed_, &released_})
            list_.scalar(std::exchange(*count, 0U));
        for (Writer* part : {&creations_, &changes_, &releases_}) {
            list_.bytes(part->written());
            part->clear();
        }
    }

    const std::vector<field::TypeId>& types_;
    Writer list_, creations_, changes_, releases_;
    std::uint32_t created_ = 0, changed_ = 0, released_ = 0;
};

class Follower {
public:
    /// False where it was refused: then the aspect is not to be used again.
    bool apply(std::vector<std::byte> bytes) {
        const field::ChangeList list{.bytes = std::move(bytes), .payloads = payloads_};
        field::Applied applied;
        const auto done = aspect_.apply(list, &applied);
        if (!done) {
            require(done.error().code == Errc::protocol, "a refusal is an error of protocol");
            return false;
        }
        flat_.update(root(), {}, applied);
        // Understood: then another can follow it.
        field::Aspect next{types_, 0};
        require(next.apply(aspect_.snapshot()).has_value(), "a snapshot can be applied");
        require(next.digest() == aspect_.digest(), "a snapshot is the same");
        require(next.snapshot().bytes == aspect_.snapshot().bytes, "to the byte");
        aspect_.forEach([](const field::FieldContainer& container) { print(container); });
        return true;
    }

private:
    scene::Ref<scene::Node> root() const {
        scene::Ref<scene::Node> found;
        aspect_.forEach([&](const field::FieldContainer& container) {
            const auto* node = aspect_.get(scene::Ref<scene::Node>{container.id()});
            if (node == nullptr || node->parent()) return;
            if (!found || container.id() < found.id) found = scene::Ref<scene::Node>{*node};
        });
        return found;
    }

    // Made once: they take longer than most lists.
    static inline const field::TypeRegistry types_ = fuzzTypes();
    static inline const std::vector<field::Payload> payloads_ = knownPayloads();
    field::Aspect aspect_{types_, 0};
    scene::FlatScene flat_{aspect_};
};

}  // namespace
}  // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon::fuzz;
    static const auto ids = fuzzTypeIds();
    Follower follower;
    ListMaker maker{ids};
    for (const Step& step : parsedScript({data, size})) {
        const unsigned kind = step.kind & 7U;
        if (kind != 0) maker.add(step);
        if (kind == 0 && !follower.apply(step.bytes)) return 0;
        if (kind == 5 && !follower.apply(maker.take())) return 0;
    }
    follower.apply(maker.take());
    return 0;
}
