// The pictures of a model's own materials: files beside the model, or inside it.
#pragma once

#include "scene/import.h"
#include "scene/scene.h"
#include "spectrum/resolver.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spectrad {

/// A file's first bytes say PNG or JPEG.
[[nodiscard]] bool isPictureFile(std::string_view firstBytes);

/// Finds pictures as materials ask for them. What is not there, is no picture, or must not be read
/// (`--restrict`) is left out and said: a model is shown without it, as ever.
class GraftedPictures {
  public:
    GraftedPictures(Scene& scene, const ImportedScene& model, const SpectrumResolver& resolver,
                    SourceLocation where);

    [[nodiscard]] std::optional<TextureUse> use(const ImportedPicture& picture);
    /// One more line of warn().
    void remark(std::string text);
    void warn(Notes& notes) const;

  private:
    [[nodiscard]] std::optional<std::filesystem::path> find(const std::string& name);
    [[nodiscard]] std::shared_ptr<const std::string> inside(std::uint32_t number);

    Scene& scene_;
    const ImportedScene& model_;
    const SpectrumResolver& resolver_;
    SourceLocation where_;
    std::filesystem::path file_;  ///< the model
    std::vector<std::shared_ptr<const std::string>> inside_;
    std::vector<std::string> remarks_;
};

}  // namespace spectrad
