// What a frame costs between a client and its servers, on loopback, in one process, in the clear
// and over TLS: the barrier alone, a frame with many changes, and bulk data. Servers draw nothing.
#include <benchmark/benchmark.h>

#include <deque>
#include <random>

#include "TestServer.h"

namespace gnomon::net::test {
namespace {

/// A hub and its servers, all of which take part.
class Session {
public:
    Session(std::int64_t servers, bool tls) : hub_{syncOptions(), {}, keyIf(tls)} {
        for (std::int64_t i = 0; i < servers; ++i) {
            servers_.emplace_back("server" + std::to_string(i),
                                  TestServerOptions{.key = keyIf(tls)});
            hub_->connect(servers_.back().address());
        }
        orThrow(hub_->waitForAll({}, eventually()));
    }
    field::TypeRegistry& types() { return hub_.types(); }
    void frame(field::ChangeList changes) { hub_->frame(std::move(changes), 0); }

private:
    static SharedKey keyIf(bool tls) { return tls ? testKey() : SharedKey{}; }
    static SyncOptions syncOptions() {
        return {.pipeline = 0, .digestEvery = 0, .pingInterval = 60s};
    }

    std::deque<TestServer> servers_;
    TestHub hub_;
};

/// An empty frame: Swap and Frame to each server, Ready from each.
void barrier(benchmark::State& state) {
    Session session{state.range(0), state.range(1) != 0};
    for ([[maybe_unused]] auto _ : state) session.frame({});
}
BENCHMARK(barrier)
    ->ArgNames({"servers", "tls"})
    ->ArgsProduct({{1, 2, 8}, {0, 1}})
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// A frame in which that many transforms move.
void changes(benchmark::State& state) {
    Session session{1, state.range(1) != 0};
    field::Aspect aspect{session.types(), 2};
    std::vector<const Thing*> things;
    for (std::int64_t i = 0; i < state.range(0); ++i) things.push_back(&aspect.create<Thing>());
    session.frame(aspect.commit());
    double step = 0;
    for ([[maybe_unused]] auto _ : state) {
        ++step;
        for (const Thing* thing : things) field::edit(*thing)->place = Placement{.offset = {step}};
        session.frame(aspect.commit());
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(changes)
    ->ArgNames({"transforms", "tls"})
    ->ArgsProduct({{100, 10'000}, {0, 1}})
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// A frame that brings a new payload of 32 MiB.
void bulk(benchmark::State& state) {
    Session session{1, state.range(0) != 0};
    field::Aspect aspect{session.types(), 2};
    const Thing& thing = aspect.create<Thing>();
    std::mt19937 random{1};
    const std::array payloads{randomPayload(random, std::size_t{32} << 20U),
                              randomPayload(random, std::size_t{32} << 20U)};
    session.frame(aspect.commit());
    std::size_t next = 0;
    for ([[maybe_unused]] auto _ : state) {
        field::edit(thing)->data = payloads[next];
        next = 1 - next;
        session.frame(aspect.commit());
    }
    state.SetBytesProcessed(state.iterations() * (std::int64_t{32} << 20U));
}
BENCHMARK(bulk)->ArgNames({"tls"})->DenseRange(0, 1)->MeasureProcessCPUTime()->UseRealTime()->Unit(
    benchmark::kMillisecond);

}  // namespace
}  // namespace gnomon::net::test
