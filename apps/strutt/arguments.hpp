#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace strutt::app {

/// What the user wrote for every subcommand. Numbers stay text until they are read strictly
/// (scene_arguments.hpp).
struct CommonArguments {
  std::string scene;
  std::optional<std::string> tolerance;
  std::optional<std::string> method;
  std::optional<std::string> threads;
  std::vector<std::string> set;
  std::optional<std::string> output;
  bool json = false;
  bool quiet = false;
  bool force = false;
  bool dry_run = false;
  std::string command;  ///< the command line as recorded in files: without what does not change the data
};

struct ChartArguments : CommonArguments {
  std::optional<std::string> x;
  std::optional<std::string> y;
  std::optional<std::string> layers;
  std::optional<std::string> figure;
};

struct StabilityArguments : CommonArguments {
  std::optional<std::string> points;
};

struct MotionArguments : CommonArguments {
  std::string angle;
  std::string velocity;
  std::optional<std::string> duration;
  std::optional<std::string> samples;
  std::optional<std::string> times;
  bool linear = false;
};

struct NormalFormArguments : CommonArguments {
  std::string points;
};

struct CharacteristicArguments : CommonArguments {
  std::string order;
  std::string q;
};

struct TonguesArguments : CommonArguments {
  std::string along;
  std::optional<std::string> at;
  std::optional<std::string> count;
  bool growth = false;
  std::optional<std::string> over;
  std::optional<std::string> chord;
  std::optional<std::string> figure;
};

struct MarginArguments : CommonArguments {
  std::optional<std::string> parameters;
  std::optional<std::string> bands;
  std::optional<std::string> closing_damping;
  std::optional<std::string> box;
  std::optional<std::string> edge;
  std::optional<std::string> count;
  bool sensitivities = false;
};

struct PeriodArguments : CommonArguments {  // scene: empty if --scene was not given
  std::optional<std::string> amplitude;
  std::optional<std::string> from_top;
  std::optional<std::string> separatrix_excess;
  std::optional<std::string> points;
  bool compare = false;
  std::optional<std::string> figure;
};

struct PortraitArguments : CommonArguments {  // the scene may be missing
  std::optional<std::string> cells;
  std::optional<std::string> curves;
  std::optional<std::string> points;
  std::optional<std::string> amplitudes;
  std::optional<std::string> excesses;
  std::optional<std::string> sections;
  std::optional<std::string> starts;
  std::optional<std::string> figure;
};

struct TradeoffArguments : CommonArguments {
  std::optional<std::string> samples;
  std::optional<std::string> figure;
};

/// --help or --version: text for standard output, nothing else to do.
struct Information {
  std::string text;
};

using Arguments = std::variant<Information, ChartArguments, StabilityArguments, MotionArguments,
                               PeriodArguments, PortraitArguments, NormalFormArguments,
                               CharacteristicArguments, TonguesArguments, MarginArguments, TradeoffArguments>;

}  // namespace strutt::app
