#include "Candidates.h"

#include <algorithm>

namespace gnomon::net {

void Candidates::begin() {
    for (One& one : list_) one.answered = false;
    tries_ = 0;
    rivalsTold_ = false;
}

Candidates::One* Candidates::find(const Place& place) {
    const auto at = std::find_if(list_.begin(), list_.end(),
                                 [&](const One& one) { return one.place == place; });
    return at == list_.end() ? nullptr : &*at;
}

void Candidates::add(const Place& place, std::uint64_t instance) {
    One fresh{.place = place, .instance = instance, .answered = true};
    if (const One* known = find(place)) {
        if (known->answered && known->instance == instance) return;
        fresh.failures = known->failures;
        fresh.tried = known->answered && known->tried;
        list_.erase(list_.begin() + (known - list_.data()));
    }
    if (list_.size() == most) {
        // Those of earlier lookups go first. Else chance decides: who answers a hundred times
        // keeps nobody out for long.
        const auto old =
            std::find_if(list_.begin(), list_.end(), [](const One& one) { return !one.answered; });
        list_.erase(old != list_.end() ? old : list_.begin() + random_() % most);
    }
    list_.push_back(std::move(fresh));
}

const Candidates::One* Candidates::best() const {
    const One* found = nullptr;
    if (tries_ == most) return found;
    for (const One& one : list_)
        if (one.answered && !one.tried && (found == nullptr || one.failures < found->failures))
            found = &one;
    return found;
}

std::optional<Place> Candidates::next() {
    const One* found = best();
    if (found == nullptr) return {};
    list_[static_cast<std::size_t>(found - list_.data())].tried = true;
    ++tries_;
    return found->place;
}

std::optional<unsigned> Candidates::failuresOfNext() const {
    const One* found = best();
    if (found == nullptr) return {};
    return found->failures;
}

void Candidates::failed(const Place& place) {
    if (One* one = find(place)) ++one->failures;
}

void Candidates::worked(const Place& place) {
    if (One* one = find(place)) one->failures = 0;
}

std::optional<std::pair<Place, Place>> Candidates::rivals() {
    const auto places = all();
    if (rivalsTold_ || places.size() < 2) return {};
    rivalsTold_ = true;
    return std::pair{places[0], places[1]};
}

std::vector<Place> Candidates::all() const {
    std::vector<Place> places;
    for (std::size_t i = 0; i < list_.size(); ++i) {
        const bool again = std::any_of(
            list_.begin(), list_.begin() + static_cast<std::ptrdiff_t>(i),
            [&](const One& one) { return one.answered && one.instance == list_[i].instance; });
        if (list_[i].answered && !again) places.push_back(list_[i].place);
    }
    return places;
}

}  // namespace gnomon::net
