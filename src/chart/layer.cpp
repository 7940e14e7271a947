#include <array>

#include "strutt/base/error.hpp"
#include "strutt/chart/stability_chart.hpp"

namespace strutt {
namespace {

struct LayerRow {
  std::string_view name;
  std::string_view unit;
  bool categorical;
};

constexpr std::array<LayerRow, kLayerCount> kLayers = {{{"verdict", "", true},
                                                        {"growth", "1", false},
                                                        {"winding", "1", false},
                                                        {"discriminant", "1", false},
                                                        {"margin", "1", false},
                                                        {"outcome", "", true}}};

const LayerRow& row(Layer layer) { return kLayers[static_cast<std::size_t>(layer)]; }

}  // namespace

std::string_view to_string(Layer layer) { return row(layer).name; }
std::string_view unit_of(Layer layer) { return row(layer).unit; }
bool is_categorical(Layer layer) { return row(layer).categorical; }

Layer layer_from_string(std::string_view name) {
  std::string known;
  for (std::size_t i = 0; i < kLayers.size(); ++i) {
    if (kLayers[i].name == name) return static_cast<Layer>(i);
    known += (i == 0 ? "" : ", ") + std::string(kLayers[i].name);
  }
  throw InvalidInput("layer", name, "one of " + known);
}

}  // namespace strutt
