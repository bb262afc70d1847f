#pragma once

#include <gnomon/field/FieldTraits.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::field {

/// What a write did to references and payloads, for the aspect's counts.
struct UseLog {
    std::vector<Id> addedRefs = {}, droppedRefs = {};
    std::vector<Payload> addedPayloads = {}, droppedPayloads = {};

    bool empty() const noexcept {
        return addedRefs.empty() && droppedRefs.empty() && addedPayloads.empty() &&
               droppedPayloads.empty();
    }
    void clear() noexcept {
        addedRefs.clear();
        droppedRefs.clear();
        addedPayloads.clear();
        droppedPayloads.clear();
    }
};

namespace detail {

template <class T>
inline constexpr bool counted = isRef<T> || std::is_same_v<T, Payload>;

/// Remembers counted values that came and went; nothing at all for other types.
template <class T, bool = counted<T>>
struct Uses {
    void swapped(const T&, const T&) noexcept {}
    void flush(UseLog&) noexcept {}
};

template <class T>
struct Uses<T, true> {
    void swapped(const T& old, const T& now) {
        if (old) dropped.push_back(old);
        if (now) added.push_back(now);
    }
    void flush(UseLog& log) {
        if constexpr (isRef<T>) {
            for (const auto& ref : added) log.addedRefs.push_back(ref.id);
            for (const auto& ref : dropped) log.droppedRefs.push_back(ref.id);
        } else {
            log.addedPayloads.insert(log.addedPayloads.end(), added.begin(), added.end());
            log.droppedPayloads.insert(log.droppedPayloads.end(), dropped.begin(), dropped.end());
        }
        added.clear();
        dropped.clear();
    }
    std::vector<T> added = {}, dropped = {};
};

}  // namespace detail

/// A single value of a container. Containers in an aspect are const outside an edit scope, so
/// assignment compiles only through `edit(container)->name = value`. Writing an equal value marks
/// nothing.
template <class T>
class Field {
public:
    using Value = T;
    static constexpr bool multi = false;
    static constexpr std::string_view layout = FieldTraits<T>::layout;

    Field() = default;
    Field(T value) : value_{std::move(value)} {}

    const T& get() const noexcept { return value_; }
    operator const T&() const noexcept { return value_; }
    const T& operator*() const noexcept { return value_; }
    const T* operator->() const noexcept { return &value_; }

    Field& operator=(T value) {
        if (value == value_) return *this;
        uses_.swapped(value_, value);
        value_ = std::move(value);
        touched_ = true;
        return *this;
    }

    // For the codec and the edit scope:
    bool takeTouched() noexcept { return std::exchange(touched_, false); }
    void flushUses(UseLog& log) { uses_.flush(log); }
    void write(Writer& to, bool /*whole*/) const { FieldTraits<T>::write(to, value_); }
    /// Kept also where it compares equal: 0.0 and -0.0 are two values to a digest.
    void read(Reader& from) {
        T value = FieldTraits<T>::read(from);
        uses_.swapped(value_, value);
        value_ = std::move(value);
        touched_ = true;
    }
    void clearRange() noexcept {}
    void dropUses() {
        if constexpr (detail::counted<T>) uses_.swapped(value_, T{});
    }

private:
    T value_{};
    bool touched_ = false;
    [[no_unique_address]] detail::Uses<T> uses_;
};

/// Many values of one type. Edited in part; only the range between the first and the last change
/// since the last commit travels.
///
/// On the wire: u32 size, u32 first, u32 count, then count values.
template <class T>
class MultiField {
public:
    using Value = T;
    static constexpr bool multi = true;
    static constexpr std::string_view layout = FieldTraits<T>::layout;

    std::span<const T> get() const noexcept { return values_; }
    std::size_t size() const noexcept { return values_.size(); }
    bool empty() const noexcept { return values_.empty(); }
    const T& operator[](std::size_t i) const noexcept { return values_[i]; }
    auto begin() const noexcept { return values_.cbegin(); }
    auto end() const noexcept { return values_.cend(); }

    void assign(std::vector<T> values) {
        if (values == values_) return;
        for (const T& old : values_) uses_.swapped(old, T{});
        for (const T& now : values) uses_.swapped(T{}, now);
        values_ = std::move(values);
        mark(0, values_.size());
    }
    void set(std::size_t at, T value) {
        if (values_[at] == value) return;
        uses_.swapped(values_[at], value);
        values_[at] = std::move(value);
        mark(at, at + 1);
    }
    void pushBack(T value) { insert(values_.size(), std::move(value)); }
    void insert(std::size_t at, T value) {
        uses_.swapped(T{}, value);
        values_.insert(values_.begin() + static_cast<std::ptrdiff_t>(at), std::move(value));
        mark(at, values_.size());
    }
    void erase(std::size_t at) {
        uses_.swapped(values_[at], T{});
        values_.erase(values_.begin() + static_cast<std::ptrdiff_t>(at));
        mark(at, values_.size());
    }
    void clear() { assign({}); }

    // For the codec and the edit scope:
    bool takeTouched() noexcept { return std::exchange(touched_, false); }
    void flushUses(UseLog& log) { uses_.flush(log); }
    void write(Writer& to, bool whole) const {
        const std::size_t size = values_.size();
        const std::size_t first = whole ? 0 : std::min(first_, size);
        const std::size_t last = whole ? size : std::min(std::max(last_, first), size);
        to.scalar(static_cast<std::uint32_t>(size));
        to.scalar(static_cast<std::uint32_t>(first));
        to.scalar(static_cast<std::uint32_t>(last - first));
        for (std::size_t i = first; i < last; ++i) FieldTraits<T>::write(to, values_[i]);
    }
    void read(Reader& from) {
        const std::size_t size = from.scalar<std::uint32_t>();
        const std::size_t first = from.scalar<std::uint32_t>();
        const std::size_t count = from.scalar<std::uint32_t>();
        // Nothing is allocated that the bytes at hand, or the values here already, do not justify.
        if (from.failed() ||
            count > from.remaining() / std::max<std::size_t>(minimumBytes(layout), 1) ||
            first + count > size || size > std::max(values_.size(), first + count) ||
            first > values_.size()) {
            from.fail("a multi field's range does not fit");
            return;
        }
        for (std::size_t i = size; i < values_.size(); ++i) uses_.swapped(values_[i], T{});
        values_.resize(size);
        for (std::size_t i = first; i < first + count; ++i) {
            T value = FieldTraits<T>::read(from);
            uses_.swapped(values_[i], value);
            values_[i] = std::move(value);
        }
        mark(first, first + count);
    }
    /// Counted values that came and went since flushUses(), also those that did both.
    std::span<const T> added() const noexcept { return uses_.added; }
    std::span<const T> dropped() const noexcept { return uses_.dropped; }
    void clearRange() noexcept {
        first_ = noRange;
        last_ = 0;
    }
    void dropUses() {
        for (const T& value : values_) uses_.swapped(value, T{});
    }

private:
    static constexpr std::size_t noRange = static_cast<std::size_t>(-1);

    void mark(std::size_t first, std::size_t last) noexcept {
        first_ = std::min(first_, first);
        last_ = std::max(last_, last);
        touched_ = true;
    }

    std::vector<T> values_;
    std::size_t first_ = noRange;  // changed since the last commit: [first_, last_)
    std::size_t last_ = 0;
    bool touched_ = false;
    [[no_unique_address]] detail::Uses<T> uses_;
};

}  // namespace gnomon::field
