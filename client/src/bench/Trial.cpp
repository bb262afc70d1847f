#include "Trial.h"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::client {
namespace {

constexpr std::size_t together = 12;
constexpr int warmUpRounds = 3;

struct Entry {
    std::unique_ptr<Contender> contender = {};
    BenchRow row = {};                             // as judged
    std::vector<std::vector<double>> ms = {};      // by motion
    std::vector<std::vector<double>> ratios = {};  // to the first's frame of the same round
};

class Trial {
public:
    Trial(gl::Context& context, Reference& reference, const TrialSetup& setup, Console& console)
        : context_{context},
          reference_{reference},
          setup_{setup},
          console_{console},
          judge_{reference, setup.view, setup.chapter.flickerFrames, setup.path, console} {}

    std::vector<BenchTable> run() {
        const auto& variants = setup_.chapter.variants;
        first_ = entered(ours(variants.front()));
        std::vector<Entry> batch = peers();
        std::size_t next = 1;
        do {
            for (std::size_t held = 1; next < variants.size() && held < together; ++next, ++held)
                batch.push_back(*entered(ours(variants[next])));
            measure(batch);
            batch.clear();
        } while (next < variants.size());
        return tables();
    }

private:
    std::unique_ptr<Contender> ours(const Variant& variant) {
        return makeContender(context_, reference_, setup_.view, variant,
                             [this](const std::string& t) { console_.log(LogLevel::warning, t); });
    }
    /// They take turns with the first batch.
    std::vector<Entry> peers() {
        std::vector<Entry> all;
        if (!setup_.peers) return all;
        for (auto& peer : setup_.peers(judge_, setup_.view))
            if (auto made = entered(std::move(peer))) all.push_back(*std::move(made));
        return all;
    }
    std::optional<Entry> entered(std::unique_ptr<Contender> contender);
    void measure(std::vector<Entry>& batch);
    void round(std::vector<Entry*>& all, std::size_t turn, std::size_t motion, bool count);
    bool lost(const Entry& entry, const Failure& failure) const;
    std::vector<BenchTable> tables() const;

    gl::Context& context_;
    Reference& reference_;
    const TrialSetup& setup_;
    Console& console_;
    Judge judge_;
    std::optional<Entry> first_ = {};
    std::size_t judged_ = 0;
    std::vector<std::vector<BenchRow>> rows_ =
        std::vector<std::vector<BenchRow>>(setup_.chapter.motions.size());
};

/// A peer that fails is left out; without ours there is nothing to say.
bool Trial::lost(const Entry& entry, const Failure& failure) const {
    if (!entry.contender->row().peer) return false;
    console_.log(LogLevel::warning, std::string{failure.what()} + "; going on without " +
                                        entry.contender->row().technique);
    return true;
}

std::optional<Entry> Trial::entered(std::unique_ptr<Contender> contender) {
    Entry entry{.contender = std::move(contender)};
    entry.row = entry.contender->row();
    entry.ms.resize(setup_.chapter.motions.size());
    entry.ratios.resize(setup_.chapter.motions.size());
    const auto& size = *setup_.view.view.size;
    if (!setup_.pictures.empty())
        entry.row.picture =
            slugOf(fmt::format("error {} {} {} {}x{} {} {}", setup_.chapter.name,
                               reference_.file().filename().string(), setup_.view.name, size[0],
                               size[1], entry.row.technique, entry.row.mapSize)) +
            ".png";
    try {
        judge_.judge(
            *entry.contender, entry.row,
            entry.row.picture.empty() ? setup_.pictures : setup_.pictures / entry.row.picture);
    } catch (const Failure& failure) {
        if (!lost(entry, failure)) throw;
        return {};
    }
    console_.progress("judging",
                      std::min(1.0, static_cast<double>(++judged_) /
                                        static_cast<double>(setup_.chapter.variants.size())),
                      entry.row.technique);
    return entry;
}

void Trial::round(std::vector<Entry*>& all, std::size_t turn, std::size_t motion, bool count) {
    // Nobody always goes first.
    std::vector<double> ms(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::size_t who = (i + turn) % all.size();
        if (all[who]->contender == nullptr) continue;
        try {
            ms[who] = all[who]->contender->frame(setup_.chapter.motions[motion]);
        } catch (const Failure& failure) {
            if (!lost(*all[who], failure)) throw;
            all[who]->contender.reset();
        }
    }
    for (std::size_t i = 0; count && i < all.size(); ++i) {
        all[i]->ms[motion].push_back(ms[i]);
        all[i]->ratios[motion].push_back(ms[i] / ms[0]);
    }
}

void Trial::measure(std::vector<Entry>& batch) {
    std::vector<Entry*> all{&*first_};
    for (Entry& entry : batch) all.push_back(&entry);
    const auto rounds = static_cast<std::size_t>(setup_.frames + warmUpRounds);
    for (std::size_t motion = 0; motion < setup_.chapter.motions.size(); ++motion) {
        for (std::size_t turn = 0; turn < rounds; ++turn) {
            round(all, turn, motion, turn >= warmUpRounds);
            console_.progress("frames", static_cast<double>(turn + 1) / static_cast<double>(rounds),
                              name(setup_.chapter.motions[motion]));
        }
        // What a frame cost beside time is what the last one of this motion cost.
        for (Entry* entry : all) {
            if (entry->contender == nullptr) continue;
            const BenchRow drawn = entry->contender->row();
            BenchRow row = entry->row;
            row.triangles = drawn.triangles;
            row.mapTexels = drawn.mapTexels;
            row.mapBytes = drawn.mapBytes;
            row.degenerate = drawn.degenerate;
            row.frameMs = medianOf(entry->ms[motion]);
            row.ratio = medianOf(entry->ratios[motion]);
            if (entry != &*first_)
                rows_[motion].push_back(row);
            else if (rows_[motion].empty())
                rows_[motion].push_back(row);
            else
                rows_[motion].front() = row;  // with the frames of every batch
        }
    }
}

std::vector<BenchTable> Trial::tables() const {
    std::vector<BenchTable> all;
    const auto& size = *setup_.view.view.size;
    for (std::size_t motion = 0; motion < rows_.size(); ++motion) {
        all.push_back({.chapter = setup_.chapter.name,
                       .scene = reference_.file().filename().string(),
                       .view = setup_.view.name,
                       .renderer = context_.renderer(),
                       .width = size[0],
                       .height = size[1],
                       .dynamic = setup_.chapter.motions[motion] == Motion::moving,
                       .frames = setup_.frames,
                       .rows = rows_[motion]});
        auto& rows = all.back().rows;
        std::stable_partition(rows.begin(), rows.end(), [](const auto& row) { return !row.peer; });
    }
    return all;
}

}  // namespace

std::vector<BenchTable> runTrial(gl::Context& context, Reference& reference,
                                 const TrialSetup& setup, Console& console) {
    return Trial{context, reference, setup, console}.run();
}

}  // namespace gnomon::client
