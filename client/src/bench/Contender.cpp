#include "Contender.h"

#include <chrono>
#include <optional>

#include "../LocalSession.h"
#include "../Nudge.h"

namespace gnomon::client {
namespace {

using Clock = std::chrono::steady_clock;

class OwnContender final : public Contender {
public:
    OwnContender(gl::Context& context, const Reference& reference, const BenchView& view,
                 const Variant& variant, std::function<void(std::string)> report)
        : session_{context, std::move(report)},
          stage_{session_.aspect(), reference, view, variant.shadow},
          nudge_{session_.aspect(), stage_.scene().tree,
                 activeLights(session_.aspect(), stage_.scene())},
          row_{.technique = variant.label, .mapSize = variant.mapSize()} {
        session_.commit();
    }

    double frame(Motion motion) override {
        const auto begin = Clock::now();
        if (motion == Motion::moving) {
            nudge_.step();
            session_.commit();
        }
        const auto drawn =
            orThrow(session_.renderer().draw(session_.rendered(stage_.window()), 0.0));
        session_.renderer().finish();
        const double ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
        row_.triangles = drawn.triangles + drawn.shadowTriangles;
        row_.mapTexels = drawn.mapTexels;
        row_.mapBytes = drawn.mapBytes;
        row_.degenerate = drawn.degenerate;
        return ms;
    }

    image::Image factor() override {
        const scene::Window& drawn = session_.rendered(stage_.window());
        orThrow(session_.renderer().draw(drawn, 0.0));
        return orThrow(session_.renderer().shadowFactor(drawn, 0, stage_.light()));
    }

    void take(const Step& step) override {
        stage_.take(step);
        session_.commit();
    }

    BenchRow row() const override { return row_; }

private:
    LocalSession session_;
    Stage stage_;
    Nudge nudge_;
    BenchRow row_;
};

}  // namespace

std::unique_ptr<Contender> makeContender(gl::Context& context, const Reference& reference,
                                         const BenchView& view, const Variant& variant,
                                         std::function<void(std::string)> report) {
    return std::make_unique<OwnContender>(context, reference, view, variant, std::move(report));
}

}  // namespace gnomon::client
