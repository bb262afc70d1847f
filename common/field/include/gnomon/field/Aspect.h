#pragma once

#include <gnomon/field/ChangeList.h>
#include <gnomon/field/ContainerTable.h>
#include <gnomon/field/FieldContainer.h>

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace gnomon::field {

/// The payloads an aspect knows of, by content: those its fields use, and those that came with the
/// list being applied.
class PayloadStore final : public PayloadSource {
public:
    Payload find(const Hash128& hash) const override;
    void arrive(const std::vector<Payload>& payloads);
    /// Forgets what arrived and is not used.
    void endArrival();
    void use(const Payload& payload);
    /// True when nothing uses it any more.
    bool drop(const Hash128& hash);
    bool used(const Hash128& hash) const { return used_.contains(hash); }

private:
    /// Held here too: fields may hold equal payloads that do not share their bytes, and the one
    /// that is found must not depend on which of them stays.
    struct Used {
        Payload payload = {};
        std::uint32_t fields = 0;
    };
    std::unordered_map<Hash128, Used> used_;
    std::unordered_map<Hash128, Payload> arrived_;
};

struct ContainerDigest {
    Id id = {};
    std::uint64_t digest = 0;
    friend bool operator==(const ContainerDigest&, const ContainerDigest&) = default;
};

/// One thread's or one process's copy of the containers.
///
/// Used by one thread at a time. Containers whose id is of this aspect's space are written here,
/// and only here; others arrive in change lists. `commit()` returns what changed since the last
/// one, and `apply()` does the same to another aspect.
class Aspect {
public:
    /// @param space  1..65535: the id space this aspect writes; 0: it only receives.
    /// @param recordLocal  also commit types that are not replicated (for importers).
    explicit Aspect(const TypeRegistry& types, std::uint16_t space, bool recordLocal = false);
    ~Aspect();
    Aspect(const Aspect&) = delete;
    Aspect& operator=(const Aspect&) = delete;

    template <class T>
    const T& create() {
        return static_cast<const T&>(create(types_.of<T>()));
    }
    const FieldContainer& create(const TypeInfo& type);

    const FieldContainer* find(Id id) const noexcept;
    /// nullptr where there is no such container or it is not a T.
    template <class T>
    const T* get(Ref<T> ref) const noexcept {
        const FieldContainer* found = find(ref.id);
        if (found == nullptr) return nullptr;
        if constexpr (requires { T::typeName; }) {
            return found->type().id == typeIdOf(T::typeName) && !found->type().opaque
                       ? static_cast<const T*>(found)
                       : nullptr;
        } else {
            return dynamic_cast<const T*>(found);
        }
    }
    template <class Fn>
    void forEach(Fn&& fn) const {
        containers_.forEach([&](const FieldContainer& container) { fn(container); });
    }
    std::size_t size() const noexcept { return containers_.size(); }
    const TypeRegistry& types() const noexcept { return types_; }
    std::uint16_t space() const noexcept { return space_; }

    /// Refused (Errc::edit) while a field of another container refers to it.
    Result<void> destroy(const FieldContainer& container);
    /// Destroys it and everything that only it kept referenced. Refused as above.
    Result<void> destroyTree(const FieldContainer& container);

    /// What changed here since the last commit, and forget it. Empty where nothing did.
    ChangeList commit();
    /// Applies another aspect's commits. Errors are Errc::protocol and leave this aspect half
    /// changed: drop it.
    Result<void> apply(const ChangeList& list, Applied* applied = nullptr);
    /// Takes in containers made elsewhere (by an importer, in space 0) as this aspect's own: they
    /// get new ids here, and the next commit carries them. Returns what their ids were moved by.
    Result<std::uint64_t> adopt(const ChangeList& list);
    /// A list that makes an empty aspect equal to this one as of the last commit. Space, digest
    /// and payload names included; containers that are not replicated are left out.
    ChangeList snapshot() const;

    /// Sum of the digests of all replicated containers; the same in every aspect with the same
    /// content. Costs what changed since the last call.
    std::uint64_t digest();
    /// Of each replicated container, by id, to find which one drifted.
    std::vector<ContainerDigest> digests();

    /// From now on takeUnusedPayloads() is told; else it has nothing. Who follows must take them.
    void followPayloads() noexcept { followsPayloads_ = true; }
    /// Payloads that no field refers to any more, since the last call.
    std::vector<Hash128> takeUnusedPayloads();

private:
    template <class T>
    friend class Edit;

    FieldContainer& insert(const TypeInfo& type, Id id);
    void beginEdit(const FieldContainer& container) const;
    void finishEdit(FieldContainer& container);
    /// Takes what was touched into the counts; the mask.
    Mask settle(FieldContainer& container);
    /// Takes log_ into the counts of references and payloads, and empties it.
    Result<void> countUses();
    void stale(FieldContainer& container);
    std::uint64_t computeDigest(const FieldContainer& container);
    bool recorded(const FieldContainer& c) const noexcept {
        return c.type().replicated || recordLocal_;
    }
    Result<void> applyBlocks(const ChangeList& list, Applied* applied, bool own);
    Result<void> applyBlock(Reader& from, Applied* applied, bool own);
    Result<void> applyCreations(Reader& from, std::uint32_t count, Applied* applied, bool own);
    Result<void> applyChanges(Reader& from, std::uint32_t count,
                              std::vector<FieldContainer*>& touched, Applied* applied, bool own);
    Result<void> applyReleases(Reader& from, std::uint32_t count,
                               std::vector<FieldContainer*>& going, bool own);
    /// Fails only where change lists made it unsound.
    Result<void> drop(FieldContainer& container, std::vector<Id>* orphans);
    void erase(FieldContainer& container);
    void listCreated(FieldContainer& container);

    const TypeRegistry& types_;
    const std::uint16_t space_;
    const bool recordLocal_;
    std::uint64_t nextCounter_ = 1;
    ContainerTable containers_;
    PayloadStore payloads_;
    bool followsPayloads_ = false;
    std::vector<Hash128> unusedPayloads_;

    // Since the last commit; nullptr where a container was destroyed again.
    std::vector<FieldContainer*> created_;
    std::vector<FieldContainer*> changed_;  // pending_ != 0
    std::vector<Id> destroyed_;
    Writer writer_;
    UseLog log_;

    std::uint64_t digest_ = 0;
    std::vector<Id> staleDigests_;
    Writer digestWriter_;
};

/// An edit scope: the only way to write fields. Nests. Marks just what it wrote.
///
///     { auto e = edit(transform); e->matrix = m; }
///     edit(transform)->matrix = m;
///
/// @throws Failure Errc::edit when the container is written by another aspect.
template <class T>
class Edit {
public:
    explicit Edit(const T& container) : container_{const_cast<T&>(container)} {
        container.aspect().beginEdit(container);
    }
    ~Edit() { container_.aspect().finishEdit(container_); }
    Edit(const Edit&) = delete;
    Edit& operator=(const Edit&) = delete;

    T* operator->() const noexcept { return &container_; }
    T& operator*() const noexcept { return container_; }

private:
    T& container_;
};

template <class T>
[[nodiscard]] Edit<T> edit(const T& container) {
    return Edit<T>{container};
}

}  // namespace gnomon::field
