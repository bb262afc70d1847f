// Faults of links. Client and servers live in network namespaces: `left` has a good link, what
// comes over that of `right` is lost, delayed or cut.
#include "FaultTest.h"
#include "Namespaces.h"
#include "TunLink.h"

namespace gnomon::faults {
namespace {

class Link : public FaultTest {
protected:
    void SetUp() override {
        const auto why = whyNoNamespaces();
        if (!why.empty()) GTEST_SKIP() << why;
        client = std::make_unique<Namespace>();
        nearBy = std::make_unique<Namespace>();
        far = std::make_unique<Namespace>();
        wire(*client, "wire0", "10.99.1.1/24", *nearBy, "wire1", "10.99.1.2/24");
    }
    void TearDown() override {
        servers.clear();
        FaultTest::TearDown();
    }

    /// A pair of the kernel's own virtual Ethernet devices.
    static void wire(const Namespace& one, const std::string& oneName,
                     const std::string& oneAddress, const Namespace& other,
                     const std::string& otherName, const std::string& otherAddress) {
        {
            const Inside inside{one};
            command({"ip", "link", "add", oneName, "type", "veth", "peer", "name", otherName,
                     "netns", other.path()});
            command({"ip", "address", "add", oneAddress, "dev", oneName});
            command({"ip", "link", "set", oneName, "up"});
        }
        const Inside inside{other};
        command({"ip", "address", "add", otherAddress, "dev", otherName});
        command({"ip", "link", "set", otherName, "up"});
    }
    void tun(const Weather& weather = {}) {
        link = std::make_unique<TunLink>(*client, "10.99.2.1/24", *far, "10.99.2.2/24", weather);
    }

    std::unique_ptr<Program> start(const std::string& name) {
        const bool isLeft = name == left();
        const Inside inside{isLeft ? *nearBy : *far};
        return standingServer(name, isLeft ? "10.99.1.2" : "10.99.2.2", 7430);
    }
    void startServers() {
        for (const auto& name : names) servers.push_back(start(name));
    }
    std::string wall(const std::string& sync) {
        return standingWall(sync, {"10.99.1.2", "10.99.2.2"}, {7430, 7430});
    }
    std::unique_ptr<Program> run(const std::string& wall, std::vector<std::string> more = {}) {
        auto words = measured({"run", wall});
        words.insert(words.end(), more.begin(), more.end());
        const Inside inside{*client};
        return std::make_unique<Program>(words);
    }

    /// All frames were shown, with both servers, and nobody's scene drifted.
    void expectWhole(Program& run, int frames) {
        EXPECT_EQ(run.wait(), 0) << testing::PrintToString(run.errors()) << run.output();
        EXPECT_EQ(run.output().find("drifted"), std::string::npos) << run.output();
        EXPECT_EQ(told()["frames"], frames);
        for (const auto& server : told()["servers"]) EXPECT_EQ(server["lost"], 0) << run.output();
    }
    void tellFigures() const {
        const auto trace = this->trace();
        std::printf("[  FIGURES ] frame %.2f ms, 99 %% below %.0f ms, longest %.0f ms\n",
                    trace.median(1, trace.rows().size()), told()["frame_ms"]["p99"].get<double>(),
                    trace.longest(1, trace.rows().size()));
    }

    std::unique_ptr<Namespace> client, nearBy, far;
    std::unique_ptr<TunLink> link;
    std::vector<std::unique_ptr<Program>> servers;
};

TEST_F(Link, ThatLosesAPacketInTwentyLosesNoServer) {
    tun({.loss = 0.05});
    startServers();
    const auto run = this->run(wall("timeout = 10.0"), {"--frames", "200"});
    expectWhole(*run, 200);
    EXPECT_GT(link->lost(), 10U) << "of " << link->packets();
    tellFigures();
}

TEST_F(Link, OfFiftyMillisecondsSetsTheFrameRateAndLosesNoServer) {
    tun({.delay = 25ms});
    startServers();
    const auto run = this->run(wall("timeout = 2.0"), {"--frames", "40"});
    expectWhole(*run, 40);
    const auto trace = this->trace();
    // One round trip a frame, and no second one.
    EXPECT_GT(trace.median(2, trace.rows().size()), 45.0);
    EXPECT_LT(trace.median(2, trace.rows().size()), 95.0);
    tellFigures();
}

TEST_F(Link, ThatReordersPacketsMixesNothingUp) {
    tun({.jitter = 3ms});
    startServers();
    const auto scene = folder.write("scene.obj", "v -9 0 -9\nv 9 0 -9\nv 9 0 9\nf 3 2 1\n");
    const auto way =
        folder.write("way.jsonl",
                     "{\"time\": 0, \"eye\": [0,1,5], \"center\": [0,0,0], \"up\": [0,1,0]}\n"
                     "{\"time\": 2, \"eye\": [5,1,0], \"center\": [0,0,0], \"up\": [0,1,0]}\n");
    const auto run =
        this->run(wall("timeout = 2.0"), {"--frames", "300", "--scene", scene, "--path", way});
    expectWhole(*run, 300);
    EXPECT_GT(link->overtook(), 20U) << "of " << link->packets();
    tellFigures();
}

/// A mesh of so many triangles that its vertices and indices take some MB.
std::string grid(int side) {
    std::string lines;
    for (int z = 0; z <= side; ++z)
        for (int x = 0; x <= side; ++x)
            lines += fmt::format("v {} {} {}\n", x * 0.1, ((x * 7 + z * 13) % 10) * 0.05, z * 0.1);
    const auto at = [&](int x, int z) { return z * (side + 1) + x + 1; };
    for (int z = 0; z < side; ++z)
        for (int x = 0; x < side; ++x)
            lines += fmt::format("f {} {} {} {}\n", at(x, z), at(x, z + 1), at(x + 1, z + 1),
                                 at(x + 1, z));
    return lines;
}

/// A server behind a link of so many Mbit/s.
class SlowLink : public Link {
protected:
    void slow(int megabits) {
        wire(*client, "slow0", "10.99.2.1/24", *far, "slow1", "10.99.2.2/24");
        const Inside inside{*client};
        command({"tc", "qdisc", "add", "dev", "slow0", "root", "tbf", "rate",
                 fmt::format("{}mbit", megabits), "burst", "16kb", "latency", "200ms"});
    }
    std::string uncompressed(const std::string& file) {
        std::ofstream{file, std::ios::app}
            << "compress = \"never\"\n";  // in [cluster], the last table
        return file;
    }
};

// What it carries is compressed, and the rest of the wall gets its own as it is.
TEST_F(SlowLink, CarriesWhatIsCompressed) {
    slow(200);
    startServers();
    const auto scene = folder.write("grid.obj", grid(300));
    std::uint64_t sent[2] = {};
    for (const bool compress : {false, true}) {
        auto file = wall("timeout = 20.0");
        if (!compress) file = uncompressed(file);
        const auto run = this->run(file, {"--frames", "100", "--scene", scene});
        expectWhole(*run, 100);
        sent[compress ? 1 : 0] = told()["sent"]["bulk_bytes"].get<std::uint64_t>();
        const auto spared = told()["sent"]["spared_bytes"].get<std::uint64_t>();
        EXPECT_EQ(spared > 0, compress);
        std::printf("[  FIGURES ] %.2f MB sent, %.2f spared\n",
                    static_cast<double>(sent[compress]) * 1e-6, static_cast<double>(spared) * 1e-6);
    }
    // To one server of two.
    EXPECT_LT(sent[1], sent[0] * 9 / 10);
    EXPECT_GT(sent[1], sent[0] / 2);
}

// A server behind a slow link loads for seconds; the wall does not wait for it.
TEST_F(SlowLink, OfALimitedRateHoldsNobodyElseUp) {
    // So that there are as many frames a second as a wall that draws may have: those of one that
    // does not would fill the slow link alone.
    {
        const Inside inside{*client};
        command({"ip", "link", "delete", "wire0"});
    }
    const TunLink good{*client, "10.99.1.1/24", *nearBy, "10.99.1.2/24", {.delay = 2ms}};
    slow(8);
    startServers();
    const auto scene = folder.write("grid.obj", grid(160));
    const auto run = this->run(uncompressed(wall("timeout = 1.0")), {"--scene", scene});
    ASSERT_TRUE(run->says("fps")) << run->output();
    servers[1].reset();
    ASSERT_TRUE(run->says("goes on without " + right())) << run->output();
    servers[1] = start(right());
    ASSERT_TRUE(run->says(right() + " takes part")) << run->output();
    ASSERT_TRUE(run->says("fps")) << run->output();
    end(*run);
    const auto trace = this->trace();
    expectOneGap(trace, 1000.0);
    // A megabyte and more went over 1 MB/s before it took part.
    const auto drop = trace.dropOf(right());
    const auto join = trace.joinOf(right(), drop);
    ASSERT_LT(join, trace.rows().size());
    EXPECT_GT(trace.rows()[join].s - trace.rows()[drop].s, 0.8);
    EXPECT_GT(join - drop, 50U) << "frames while it loaded";
}

TEST_F(Link, ThatIsCutCostsOneGapAndTheServerComesBackWithIt) {
    tun();
    startServers();
    const auto run = this->run(wall("timeout = 1.0"));
    ASSERT_TRUE(run->says("fps")) << run->output();
    link->cut();
    ASSERT_TRUE(run->says("(it answers nothing)")) << run->output();
    ASSERT_TRUE(run->says("goes on without " + right())) << run->output();
    ASSERT_TRUE(run->says("fps")) << run->output();
    link->mend();
    ASSERT_TRUE(run->says(right() + " takes part")) << run->output();
    ASSERT_TRUE(run->says("fps")) << run->output();
    end(*run);
    expectOneGap(trace(), 1000.0);
}

TEST_F(Link, ThatIsCutForLessThanTheTimeoutLosesNobody) {
    tun();
    startServers();
    const auto run = this->run(wall("timeout = 10.0"));
    ASSERT_TRUE(run->says("fps")) << run->output();
    link->cut();
    last(300ms);
    link->mend();
    ASSERT_TRUE(run->says("fps")) << run->output();
    end(*run);
    for (const auto& server : told()["servers"]) EXPECT_EQ(server["lost"], 0);
    EXPECT_GT(trace().longest(1, trace().rows().size()), 250.0);
    tellFigures();
}

// The machine of a server loses its power: nobody says that the connection ended.
TEST_F(Link, HalfOpenWhenAServersMachineVanishes) {
    wire(*client, "half0", "10.99.2.1/24", *far, "half1", "10.99.2.2/24");
    startServers();
    const auto run = this->run(wall("timeout = 1.0"));
    ASSERT_TRUE(run->says("fps")) << run->output();
    const auto set = [&](const char* state) {
        const Inside inside{*far};
        command({"ip", "link", "set", "half1", state});
    };
    set("down");
    servers[1].reset();
    ASSERT_TRUE(run->says("goes on without " + right())) << run->output();
    set("up");
    servers[1] = start(right());
    ASSERT_TRUE(run->says(right() + " takes part")) << run->output();
    ASSERT_TRUE(run->says("fps")) << run->output();
    end(*run);
    expectOneGap(trace(), 1000.0);
}

// The machine of the client does: its servers believe it to be there, until another one comes.
TEST_F(Link, HalfOpenWhenTheClientsMachineVanishes) {
    tun();
    startServers();
    // Less than the 30 s after which a server gives a silent client up by itself.
    const auto file = wall("timeout = 0.5\nstart_timeout = 15.0");
    const auto first = run(file);
    ASSERT_TRUE(first->says("fps")) << first->output();
    link->cut();
    {
        const Inside inside{*nearBy};
        command({"ip", "link", "delete", "wire1"});
    }
    first->signal(SIGKILL);
    EXPECT_EQ(first->wait(), 128 + SIGKILL);
    // Another machine with other addresses: nobody there to say that a connection is none.
    link.reset();
    client = std::make_unique<Namespace>();
    wire(*client, "wire0", "10.99.1.3/24", *nearBy, "wire1", "10.99.1.2/24");
    link = std::make_unique<TunLink>(*client, "10.99.2.3/24", *far, "10.99.2.2/24");
    const auto second = run(file);
    ASSERT_TRUE(second->says("fps")) << testing::PrintToString(second->errors());
    end(*second);
    for (const auto& server : told()["servers"]) EXPECT_EQ(server["lost"], 0);
    for (const auto& server : servers) {
        const auto said = testing::PrintToString(server->errors());
        EXPECT_NE(said.find("client left: it was silent for "), std::string::npos) << said;
    }
}

}  // namespace
}  // namespace gnomon::faults
