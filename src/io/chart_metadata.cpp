#include <nlohmann/json.hpp>

#include "io/chart_writers.hpp"

namespace strutt {
namespace {

using Json = nlohmann::ordered_json;

Json axis_json(const Axis& axis, const ParameterInfo& info) {
  return {{"parameter", axis.parameter},
          {"unit", unit_of(info)},
          {"label", info.label},
          {"from", axis.from},
          {"to", axis.to},
          {"points", axis.points},
          {"scale", axis.scale == AxisScale::logarithmic ? "log" : "linear"}};
}

Json layer_json(Layer layer) {
  Json json{{"unit", unit_of(layer)}, {"long_name", long_name(layer)}};
  if (!is_categorical(layer)) return json;
  Json values = Json::object();
  int value = 0;
  for (const auto& name : category_names(layer)) values[name] = value++;
  json["values"] = values;
  return json;
}

}  // namespace

std::string_view long_name(Layer layer) {
  switch (layer) {
    case Layer::verdict:
      return "verdict on stability";
    case Layer::growth:
      return "growth per period, ln of the spectral radius";
    case Layer::winding:
      return "winding number, Im of the characteristic exponent times T/(2 pi)";
    case Layer::discriminant:
      return "discriminant, trace of the monodromy matrix";
    case Layer::margin:
      return "margin of stability, 1 - |D|/(2 cosh(cT/2))";
    case Layer::outcome:
      break;
  }
  return "how the computation ended";
}

std::string entry(const Provenance& provenance, std::string_view name) {
  for (const auto& [key, value] : provenance) {
    if (key == name) return value;
  }
  return {};
}

std::string chart_title(const ChartDescription& description) {
  const std::string title = entry(description.provenance, "title");
  if (!title.empty()) return title;
  const std::string model = entry(description.provenance, "model");
  return model.empty() ? "Stability chart" : "Stability chart: " + model;
}

std::string chart_metadata(const ChartDescription& description, const Provenance& done) {
  const ChartRequest& request = description.request;
  Json layers = Json::object();
  for (const Layer layer : request.layers) layers[std::string(to_string(layer))] = layer_json(layer);
  const Json json{{"schema_version", 1},
                  {"title", chart_title(description)},
                  {"x", axis_json(request.x, description.x)},
                  {"y", axis_json(request.y, description.y)},
                  {"layers", layers},
                  {"provenance", Json::parse(json_text(description.provenance))},
                  {"done", Json::parse(json_text(done))}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace strutt
