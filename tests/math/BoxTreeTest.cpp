// The tree finds exactly what looking at every box finds, also after boxes moved.
#include <gnomon/math/BoxTree.h>
#include <gnomon/math/View.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace gnomon::math {
namespace {

class BoxTreeTest : public testing::Test {
protected:
    double between(double low, double high) {
        return std::uniform_real_distribution<double>{low, high}(random);
    }
    Box randomBox() {
        Box box;
        const dvec3 at{between(-10.0, 10.0), between(-10.0, 10.0), between(-10.0, 10.0)};
        box.add(at);
        box.add(at + dvec3{between(0.0, 1.0), between(0.0, 1.0), between(0.0, 1.0)});
        return box;
    }
    std::vector<Box> randomBoxes(std::size_t count) {
        std::vector<Box> boxes;
        for (std::size_t i = 0; i < count; ++i)
            boxes.push_back(i % 17 == 5 ? Box{} : randomBox());  // some empty ones
        return boxes;
    }
    std::array<Plane, 6> randomFrustum() {
        const dvec3 eye{between(-12.0, 12.0), between(-12.0, 12.0), between(-12.0, 12.0)};
        const View view{.clipFromEye = perspective(between(0.3, 2.0), between(0.5, 2.0), 0.1, 15.0),
                        .eyeFromWorld = lookAt(eye, {between(-5.0, 5.0), 0.1, between(-5.0, 5.0)},
                                               {0.0, 1.0, 0.0})};
        return frustumPlanes(view.clipFromWorld());
    }
    void expectFindsAll(const BoxTree& tree) {
        for (int round = 0; round < 30; ++round) {
            const auto planes = randomFrustum();
            std::set<std::uint32_t> expected;
            for (std::uint32_t i = 0; i < tree.boxes().size(); ++i)
                if (mayIntersect(planes, tree.boxes()[i])) expected.insert(i);
            std::set<std::uint32_t> found;
            tree.visit(planes, [&](std::uint32_t item, bool inside) {
                EXPECT_TRUE(found.insert(item).second) << "found twice";
                if (!inside) return;
                for (int c = 0; c < 8; ++c)
                    for (const Plane& plane : planes)
                        EXPECT_GE(plane.distance(tree.boxes()[item].corner(c)), -1e-9);
            });
            EXPECT_EQ(found, expected);
            EXPECT_EQ(tree.any(planes), !expected.empty());
        }
    }
    std::mt19937 random{7};
};

TEST_F(BoxTreeTest, FindsWhatLookingAtEveryBoxFinds) {
    for (const std::size_t count : {0U, 1U, 4U, 5U, 100U, 3000U}) {
        BoxTree tree;
        tree.build(randomBoxes(count));
        expectFindsAll(tree);
    }
}

TEST_F(BoxTreeTest, FollowsBoxesThatMove) {
    BoxTree tree;
    tree.build(randomBoxes(500));
    for (int round = 0; round < 20; ++round) {
        // A few, and now and then all: both ways of refitting, and building anew.
        const std::uint32_t some = round % 4 == 0 ? 500U : 5U;
        for (std::uint32_t i = 0; i < some; ++i)
            tree.move(static_cast<std::uint32_t>(between(0.0, 499.9)), randomBox());
        tree.refit();
        expectFindsAll(tree);
        Box all;
        for (const Box& box : tree.boxes()) all.add(box);
        EXPECT_EQ(tree.bounds(), all);
    }
}

TEST_F(BoxTreeTest, ARayPassesWhatItPasses) {
    BoxTree tree;
    tree.build(randomBoxes(400));
    int met = 0;
    for (int round = 0; round < 200; ++round) {
        const dvec3 from{between(-12.0, 12.0), between(-12.0, 12.0), between(-12.0, 12.0)};
        // Most of them through the middle, where the boxes are.
        dvec3 way = dvec3{between(-6.0, 6.0), between(-6.0, 6.0), between(-6.0, 6.0)} - from;
        way /= glm::length(way);
        if (round % 5 == 0) way.y = 0.0;  // along a plane of the axes
        std::set<std::uint32_t> found;
        tree.along(from, way, [&](std::uint32_t item, double entry, double exit) {
            ++met;
            found.insert(item);
            EXPECT_GE(entry, 0.0);
            EXPECT_LE(entry, exit);
            const Box& box = tree.boxes()[item];
            for (const double t : {entry, exit}) {
                const dvec3 p = from + way * t;
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_GE(p[axis], box.min[axis] - 1e-9);
                    EXPECT_LE(p[axis], box.max[axis] + 1e-9);
                }
            }
        });
        // Whatever a fine walk along the ray comes through has been found.
        for (double t = 0.0; t < 30.0; t += 0.01) {
            const dvec3 p = from + way * t;
            for (std::uint32_t i = 0; i < tree.boxes().size(); ++i) {
                const Box& box = tree.boxes()[i];
                const bool inside =
                    glm::all(glm::greaterThan(p, box.min)) && glm::all(glm::lessThan(p, box.max));
                if (inside) {
                    EXPECT_TRUE(found.contains(i));
                }
            }
            if (t > 3.0 && round > 10) break;  // the whole way for some is enough
        }
    }
    EXPECT_GT(met, 40);
}

TEST_F(BoxTreeTest, ACoverHoldsEverythingThatIsFound) {
    BoxTree tree;
    tree.build(randomBoxes(800));
    for (int round = 0; round < 20; ++round) {
        const auto planes = randomFrustum();
        std::vector<Box> cover;
        tree.cover(
            planes, [](const Box& box) { return glm::length(box.size()) < 6.0; },
            [&](const Box& box, bool) { cover.push_back(box); });
        std::size_t items = 0;
        tree.visit(planes, [&](std::uint32_t item, bool) {
            ++items;
            const Box& box = tree.boxes()[item];
            EXPECT_TRUE(std::any_of(cover.begin(), cover.end(), [&](const Box& larger) {
                return glm::all(glm::lessThanEqual(larger.min, box.min)) &&
                       glm::all(glm::greaterThanEqual(larger.max, box.max));
            }));
        });
        EXPECT_LE(cover.size(), items);
    }
}

}  // namespace
}  // namespace gnomon::math
