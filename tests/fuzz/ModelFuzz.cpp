// A model file as gnomon-import reads it, without the process around it: refused with an error, or
// a scene that a client can take in. The first byte picks the format.
#include <gnomon/scene/FlatScene.h>
#include <gnomon/scene/Imported.h>
#include <gnomon/scene/Types.h>

#include <new>
#include <stdexcept>

#include "Check.h"
#include "gltf/Gltf.h"
#include "image/Image.h"
#include "obj/Mtl.h"
#include "obj/Obj.h"
#include "ply/Ply.h"

namespace gnomon::fuzz {
namespace {

using importer::Folder;
using importer::SceneBuilder;
using Bytes = std::span<const std::byte>;

void takeIn(const field::TypeRegistry& types, const field::ChangeList& list) {
    field::Aspect aspect{types, 2};
    require(aspect.adopt(list).has_value(), "a client can take in what was read");
    const auto committed = aspect.commit();
    field::Aspect server{types, 0};
    field::Applied applied;
    require(server.apply(committed, &applied).has_value(), "and a server");
    require(server.digest() == aspect.digest(), "which has the same");
    scene::FlatScene flat{aspect};
    aspect.forEach([&](const field::FieldContainer& container) {
        if (const auto* made = aspect.get(scene::Ref<scene::ImportedScene>{container.id()}))
            flat.update(made->root, {}, {});
    });
}

template <auto read>
void readModel(Bytes bytes) {
    static Folder folder{"/nonexistent/model"};  // no side files
    static const auto types = [] {
        field::TypeRegistry made;
        scene::addTypes(made);
        return made;
    }();
    importer::Report report;
    SceneBuilder scene{types, report};
    read(bytes, folder, scene);
    takeIn(types, scene.finish("model"));
    report.warnings();
}

void readMtl(Bytes bytes) {
    importer::Report report;
    importer::MtlLibrary library;
    importer::parseMtl(importer::asText(bytes), "model.mtl", library, report);
}

void readImage(Bytes bytes) {
    const auto header = importer::imageHeader(bytes);
    // A large picture is within the limits, and slow.
    if (!header || header->decodedBytes() > (1U << 20U)) return;
    const auto image = importer::decodedImage(bytes);
    if (!image) return;
    require(image->pixels.size() == header->decodedBytes(), "a picture is as large as it said");
    importer::meanOf(*image);
    importer::normalsFromHeights(*image, 1.0F);
}

constexpr std::array readers{&readModel<importer::readGltf>, &readModel<importer::readObj>,
                             &readModel<importer::readPly>, &readMtl, &readImage};

}  // namespace
}  // namespace gnomon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gnomon;
    if (size == 0) return 0;
    try {
        fuzz::readers[data[0] % fuzz::readers.size()](std::as_bytes(std::span{data + 1, size - 1}));
    } catch (const Failure&) {
        // Refused. What else main() catches, memory above all, is a finding here.
    }
    return 0;
}
