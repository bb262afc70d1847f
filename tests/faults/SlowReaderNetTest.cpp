// A server that does not read what it is sent: a proxy before it stops reading.
#include "FaultTest.h"
#include "Proxy.h"

namespace gnomon::faults {
namespace {

class SlowReader : public FaultTest {
protected:
    void SetUp() override {
        const std::vector<int> ports{freePort(), freePort()};
        for (std::size_t i = 0; i < 2; ++i)
            servers.push_back(standingServer(names[i], "0.0.0.0", ports[i]));
        proxy = std::make_unique<Proxy>(ports[1]);
        this->ports = {ports[0], proxy->port()};
    }
    void TearDown() override {
        proxy.reset();
        servers.clear();
        FaultTest::TearDown();
    }
    std::string wall(const std::string& sync) {
        return standingWall(sync, {"0.0.0.0", "0.0.0.0"}, ports);
    }

    std::vector<int> ports;
    std::unique_ptr<Proxy> proxy;
    std::vector<std::unique_ptr<Program>> servers;
};

TEST_F(SlowReader, CostsOneGapAndComesBackWhenItReads) {
    Program run{measured({"run", wall("timeout = 1.0")})};
    ASSERT_TRUE(run.says("fps")) << run.output();
    proxy->stopReading();
    ASSERT_TRUE(run.says("(it answers nothing)")) << run.output();
    ASSERT_TRUE(run.says("goes on without " + right())) << run.output();
    ASSERT_TRUE(run.says("fps")) << run.output();
    proxy->readAgain();
    ASSERT_TRUE(run.says(right() + " takes part")) << run.output();
    ASSERT_TRUE(run.says("fps")) << run.output();
    end(run);
    expectOneGap(trace(), 1000.0);
}

TEST_F(SlowReader, IsWaitedForWhereTheWallSaysSo) {
    Program run{measured({"run", wall("timeout = 0.2\non_timeout = \"wait\"")})};
    ASSERT_TRUE(run.says("fps")) << run.output();
    proxy->stopReading();
    last(1200ms);
    proxy->readAgain();
    ASSERT_TRUE(run.says("fps")) << run.output();
    end(run);
    for (const auto& server : told()["servers"]) EXPECT_EQ(server["lost"], 0);
    const auto trace = this->trace();
    EXPECT_GT(trace.longest(1, trace.rows().size()), 800.0) << "it did not wait";
}

}  // namespace
}  // namespace gnomon::faults
