// gnomon-osg-peer: OpenSceneGraph's shadows, drawn a frame at a time for `gnomon bench`. How to
// talk to it: client/src/bench/Peer.h. Needs an X display with GLX; draws into a pbuffer there.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <osg/LightSource>
#include <osg/Material>
#include <osg/Notify>
#include <osgViewer/Viewer>
#include <sstream>
#include <stdexcept>

#include "Model.h"
#include "Techniques.h"

namespace {

/// Waits for the frame; copies it out where one is wanted.
struct AfterFrame final : osg::Camera::DrawCallback {
    osg::ref_ptr<osg::Image> picture = new osg::Image;
    int width = 0, height = 0;
    bool wanted = false;
    void operator()(osg::RenderInfo&) const override {
        if (wanted) picture->readPixels(0, 0, width, height, GL_RED, GL_UNSIGNED_BYTE);
        glFinish();
    }
};

osg::ref_ptr<osg::GraphicsContext> pbuffer(int width, int height) {
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->width = width;
    traits->height = height;
    traits->pbuffer = true;
    traits->depth = 24;
    traits->readDISPLAY();
    traits->setUndefinedScreenDetailsToDefaultScreen();
    osg::ref_ptr<osg::GraphicsContext> context =
        osg::GraphicsContext::createGraphicsContext(traits);
    if (!context.valid() || !context->valid())
        throw std::runtime_error(
            "no GLX pbuffer: it needs an X display (DISPLAY, or xvfb-run gnomon bench ...)");
    return context;
}

class Peer {
public:
    /// @param words  TRIANGLES TECHNIQUE MAP_SIZE WIDTH HEIGHT FOVY NEAR FAR
    explicit Peer(char** words)
        : model_{peer::readModel(words[0])},
          width_{std::stoi(words[3])},
          height_{std::stoi(words[4])} {
        const auto scene = peer::shadowedScene(words[1], std::stoi(words[2]));
        if (!scene.valid()) throw std::runtime_error(std::string{"no technique "} + words[1]);
        model_.node->setNodeMask(peer::receives | peer::casts);
        scene->addChild(model_.node);
        osg::ref_ptr<osg::Group> root = new osg::Group;
        root->addChild(makeSun());
        root->addChild(scene);
        whiteMaterial(*root->getOrCreateStateSet());

        const auto context = pbuffer(width_, height_);
        osg::Camera* camera = viewer_.getCamera();
        camera->setGraphicsContext(context);
        camera->setViewport(0, 0, width_, height_);
        camera->setDrawBuffer(GL_FRONT);
        camera->setReadBuffer(GL_FRONT);
        camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
        camera->setProjectionMatrixAsPerspective(std::stod(words[5]),
                                                 static_cast<double>(width_) / height_,
                                                 std::stod(words[6]), std::stod(words[7]));
        camera->setClearColor(osg::Vec4(0.5F, 0.5F, 0.5F, 1.0F));
        after_->width = width_;
        after_->height = height_;
        camera->setFinalDrawCallback(after_);
        viewer_.setThreadingModel(osgViewer::Viewer::SingleThreaded);
        viewer_.setLightingMode(osg::View::NO_LIGHT);
        viewer_.setCameraManipulator(nullptr, false);
        viewer_.setSceneData(root);
        viewer_.realize();
        if (!viewer_.isRealized()) throw std::runtime_error("the pbuffer cannot be drawn into");
    }

    /// Answers one line.
    std::string answer(const std::string& line) {
        std::istringstream words{line};
        std::string word;
        words >> word;
        if (word == "frame") {
            const auto begin = std::chrono::steady_clock::now();
            viewer_.frame();
            const std::chrono::duration<double, std::milli> taken =
                std::chrono::steady_clock::now() - begin;
            return "frame " + std::to_string(taken.count());
        }
        if (word == "factor") {
            writeFactor(line.substr(line.find(' ') + 1));
        } else if (word == "eye") {
            osg::Vec3d eye, center, up;
            for (auto* v : {&eye, &center, &up}) words >> v->x() >> v->y() >> v->z();
            viewer_.getCamera()->setViewMatrixAsLookAt(eye, center, up);
        } else if (word == "sun") {
            osg::Vec3 toward;
            words >> toward.x() >> toward.y() >> toward.z();
            shineFrom(toward);
        } else {
            throw std::runtime_error("does not know what \"" + line + "\" is");
        }
        if (words.fail()) throw std::runtime_error("misses numbers in \"" + line + "\"");
        return word;
    }

private:
    osg::ref_ptr<osg::LightSource> makeSun() {
        osg::Light* light = sun_->getLight();
        light->setLightNum(0);
        light->setAmbient(osg::Vec4(0, 0, 0, 1));
        light->setDiffuse(osg::Vec4(1, 1, 1, 1));
        light->setSpecular(osg::Vec4(0, 0, 0, 1));
        return sun_;
    }
    static void whiteMaterial(osg::StateSet& state) {
        osg::ref_ptr<osg::Material> material = new osg::Material;
        material->setAmbient(osg::Material::FRONT_AND_BACK, osg::Vec4(0, 0, 0, 1));
        material->setDiffuse(osg::Material::FRONT_AND_BACK, osg::Vec4(1, 1, 1, 1));
        material->setSpecular(osg::Material::FRONT_AND_BACK, osg::Vec4(0, 0, 0, 1));
        state.setAttributeAndModes(material,
                                   osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
        state.setMode(GL_LIGHT0, osg::StateAttribute::ON);
        state.setMode(GL_LIGHTING, osg::StateAttribute::ON);
        state.setMode(GL_CULL_FACE, osg::StateAttribute::OFF);
    }
    void shineFrom(osg::Vec3 toward) {
        toward.normalize();
        sun_->getLight()->setPosition(osg::Vec4(toward, 0.0F));
        sun_->getLight()->setDirection(-toward);
        if (model_.normal->front() == toward) return;
        model_.normal->front() = toward;
        model_.normal->dirty();
    }
    void writeFactor(const std::string& file) {
        after_->wanted = true;
        viewer_.frame();
        after_->wanted = false;
        std::ofstream out{file, std::ios::binary};
        out << "P5\n" << width_ << " " << height_ << "\n255\n";
        for (int y = height_ - 1; y >= 0; --y)
            out.write(
                reinterpret_cast<const char*>(after_->picture->data(0, static_cast<unsigned>(y))),
                width_);
        out.close();
        if (!out) throw std::runtime_error("cannot write " + file);
    }

    peer::Model model_;
    int width_, height_;
    osg::ref_ptr<osg::LightSource> sun_ = new osg::LightSource;
    osg::ref_ptr<AfterFrame> after_ = new AfterFrame;
    osgViewer::Viewer viewer_;
};

}  // namespace

int main(int count, char** words) {
    if (count == 2 && std::string{words[1]} == "--list") {
        for (const auto& name : peer::techniqueNames()) std::cout << name << "\n";
        return 0;
    }
    if (count != 9) {
        std::fputs(
            "usage: gnomon-osg-peer TRIANGLES TECHNIQUE MAP_SIZE WIDTH HEIGHT FOVY NEAR FAR\n"
            "       gnomon-osg-peer --list\n",
            stderr);
        return 2;
    }
    osg::setNotifyLevel(osg::ALWAYS);  // it would talk on standard output, which is ours
    try {
        Peer peer{words + 1};
        std::cout << "ready" << std::endl;
        for (std::string line; std::getline(std::cin, line);)
            std::cout << peer.answer(line) << std::endl;
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "gnomon-osg-peer: %s\n", error.what());
        return 1;
    }
}
