#include <gnomon/scene/Geometry.h>
#include <gnomon/scene/Imported.h>
#include <gnomon/scene/Light.h>
#include <gnomon/scene/ShadowState.h>
#include <gnomon/scene/Types.h>
#include <gnomon/scene/Window.h>

namespace gnomon {

void field::FieldTraits<scene::Chunk>::write(Writer& to, const scene::Chunk& chunk) {
    to.scalar(chunk.firstIndex);
    to.scalar(chunk.indexCount);
    to.scalar(static_cast<std::uint8_t>(chunk.closed));
    FieldTraits<math::vec3>::write(to, chunk.min);
    FieldTraits<math::vec3>::write(to, chunk.max);
}

scene::Chunk field::FieldTraits<scene::Chunk>::read(Reader& from) {
    scene::Chunk chunk;
    chunk.firstIndex = from.scalar<std::uint32_t>();
    chunk.indexCount = from.scalar<std::uint32_t>();
    chunk.closed = from.scalar<bool>();
    chunk.min = FieldTraits<math::vec3>::read(from);
    chunk.max = FieldTraits<math::vec3>::read(from);
    return chunk;
}

void scene::addTypes(field::TypeRegistry& types) {
    const auto add = [&]<class... T>() { (types.add<T>(), ...); };
    add.operator()<Node, Group, Transform, Geometry, Texture, PhongMaterial, ShaderMaterial,
                   MaterialGroup, DirectionalLight, PointLight, SpotLight, PerspectiveCamera,
                   MatrixCamera, StereoDecorator, ScreenDecorator, TileDecorator, User, Navigation,
                   Screen, SolidBackground, GradientBackground, ImageForeground, PlainViewport,
                   ShadowViewport, Window, ShadowState, AnimationChannel, AnimationPose, Animation,
                   ImportedScene>();
}

}  // namespace gnomon
