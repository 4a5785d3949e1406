// A report as a value: figures, tables and plots (plot/plot.hpp), whoever draws them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tilth/plot/plot.hpp>
#include <tilth/report/map_view.hpp>

namespace tilth {

/// The first column names the rows; the others hold numbers where `numeric`.
struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  bool numeric = true;
};

struct Section {
  std::string id, heading, note;
  std::vector<Table> tables;
  std::vector<Plot> plots;
};

struct Fact {
  std::string name, value;
};

struct Report {
  std::string title, subtitle;
  std::string alarm;               ///< what must be read first, in red; empty: nothing
  std::vector<Fact> facts;         ///< the few figures at the top
  std::vector<std::string> notes;  ///< sentences below them: what the figures are, what failed
  std::optional<MapView> map;
  std::vector<Section> sections;
};

}  // namespace tilth
