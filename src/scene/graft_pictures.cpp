#include "scene/graft_pictures.h"

#include "base/files.h"
#include "base/text.h"

#include <algorithm>
#include <array>
#include <fstream>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

/// %20 and the like, as in URIs.
std::string decoded(const std::string& text) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    std::string plain;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0) {
            plain += static_cast<char>(digit(text[i + 1]) * 16 + digit(text[i + 2]));
            i += 2;
        } else {
            plain += text[i];
        }
    }
    return plain;
}

/// What a name may mean, the likeliest first: as it stands, with the folders of another system, as a URI; and
/// where none of these is there, the file of that name beside the model, since many programs write down where
/// a picture was on somebody's disk.
std::vector<std::string> readings(const std::string& name) {
    std::vector<std::string> all{name};
    const auto add = [&](std::string text) {
        if (!text.empty() && std::find(all.begin(), all.end(), text) == all.end())
            all.push_back(std::move(text));
    };
    std::string slashes = name;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    add(slashes);
    std::string plain = decoded(slashes);
    if (startsWith(plain, "file://")) plain.erase(0, 7);
    add(plain);
    add(fs::path(plain).filename().string());
    return all;
}

}  // namespace

bool isPictureFile(std::string_view firstBytes) {
    return startsWith(firstBytes, "\x89PNG") || startsWith(firstBytes, "\xff\xd8\xff");
}

GraftedPictures::GraftedPictures(Scene& scene, const ImportedScene& model, const SpectrumResolver& resolver,
                                 SourceLocation where)
    : scene_(scene),
      model_(model),
      resolver_(resolver),
      where_(std::move(where)),
      file_(model.filesRead.empty() ? fs::path() : fs::path(model.filesRead.front())),
      inside_(model.pictures.size()) {}

void GraftedPictures::remark(std::string text) {
    if (std::find(remarks_.begin(), remarks_.end(), text) == remarks_.end())
        remarks_.push_back(std::move(text));
}

void GraftedPictures::warn(Notes& notes) const {
    constexpr size_t most = 6;
    for (size_t i = 0; i < std::min(remarks_.size(), most); ++i)
        notes.warn({file_.string(), 0, 0}, remarks_[i]);
    if (remarks_.size() > most)
        notes.warn({file_.string(), 0, 0},
                   "and " + std::to_string(remarks_.size() - most) + " more remarks on pictures");
}

std::optional<fs::path> GraftedPictures::find(const std::string& name) {
    bool outside = false;
    for (const std::string& reading : readings(name)) {
        const fs::path path = (file_.parent_path() / reading).lexically_normal();
        if (!resolver_.isAllowed(path)) {
            outside = true;
            continue;
        }
        if (!isFile(path)) continue;
        std::string first(4, '\0');
        std::ifstream file(path, std::ios::binary);
        file.read(first.data(), static_cast<std::streamsize>(first.size()));
        if (isPictureFile(first)) return path;
        remark("picture '" + name + "' is neither PNG nor JPEG: not shown");
        return std::nullopt;
    }
    remark("picture '" + name + "' " +
           (outside ? "lies outside the scene's folder, which is not allowed here (--restrict)"
                    : "is not there") +
           ": not shown");
    return std::nullopt;
}

std::shared_ptr<const std::string> GraftedPictures::inside(std::uint32_t number) {
    if (!inside_[number]) inside_[number] = std::make_shared<const std::string>(model_.pictures[number]);
    return inside_[number];
}

std::optional<TextureUse> GraftedPictures::use(const ImportedPicture& picture) {
    TextureUse use;
    if (picture.embedded) {
        use.bytes = inside(*picture.embedded);
        use.source = file_.string() + "#" + picture.name;
        if (!isPictureFile(*use.bytes)) {
            remark("picture '" + picture.name + "' inside it is neither PNG nor JPEG: not shown");
            return std::nullopt;
        }
    } else {
        const std::optional<fs::path> path = find(picture.name);
        if (!path) return std::nullopt;
        use.source = path->string();
        if (std::find(scene_.filesRead.begin(), scene_.filesRead.end(), use.source) == scene_.filesRead.end())
            scene_.filesRead.push_back(use.source);
    }
    use.filter = picture.nearest ? TextureFilter::nearest : TextureFilter::bilinear;
    use.isPlainSrgb = picture.isPlainSrgb;
    use.repeat = picture.repeat;
    use.offset = picture.offset;
    use.scale = picture.scale;
    use.rotateDegrees = picture.rotateDegrees;
    use.where = where_;
    return use;
}

}  // namespace spectrad
