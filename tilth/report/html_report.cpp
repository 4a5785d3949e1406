#include <fstream>
#include <system_error>

#include <tilth/core/error.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/plot/svg_canvas.hpp>
#include <tilth/plot/svg_plot.hpp>
#include <tilth/report/html_report.hpp>
#include <tilth/report/report_json.hpp>
#include <tilth/report/web_bundle.hpp>

namespace tilth {
namespace {

constexpr const char* kPlotsFolder = "plots";

std::string element(const std::string& name, std::string_view text) {
  std::string html("<");
  return html.append(name).append(">").append(markup_text(text)).append("</").append(name).append(">");
}

std::string table_html(const Table& table) {
  std::string html = "<div class=\"table\"><table" + std::string(table.numeric ? " class=\"numeric\"" : "") +
                     "><caption>" + markup_text(table.title) + "</caption>\n<thead><tr>";
  for (const std::string& column : table.columns) html += element("th", column);
  html += "</tr></thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) {
    html += "<tr>";
    for (const std::string& cell : row) html += element("td", cell);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string figure_html(const Plot& plot) {
  std::string html = "<figure data-plot=\"" + markup_text(plot.id) + "\"><figcaption>" + element("b", plot.title);
  if (!plot.note.empty()) html.append(" ").append(element("span", plot.note));
  return html + "</figcaption>\n<div class=\"drawing\">" + svg_inline(plot) + "</div></figure>\n";
}

std::string section_html(const Section& section) {
  std::string html = "<section id=\"" + markup_text(section.id) + "\">\n" + element("h2", section.heading);
  if (!section.note.empty()) html += element("p", section.note);
  html += "\n";
  for (const Table& table : section.tables) html += table_html(table);
  if (!section.plots.empty()) html += "<div class=\"plots\">\n";
  for (const Plot& plot : section.plots) html += figure_html(plot);
  if (!section.plots.empty()) html += "</div>\n";
  return html + "</section>\n";
}

std::string header_html(const Report& report) {
  std::string html = "<header>";
  if (!report.alarm.empty()) html += "<p class=\"alarm\" role=\"alert\">" + markup_text(report.alarm) + "</p>\n";
  html += element("h1", report.title) + element("p", report.subtitle) + "\n<dl class=\"facts\">";
  for (const Fact& fact : report.facts) {
    html += "<div>" + element("dt", fact.name) + element("dd", fact.value) + "</div>";
  }
  html += "</dl>\n";
  if (!report.notes.empty()) html += "<ul class=\"notes\">";
  for (const std::string& note : report.notes) html += element("li", note);
  html += report.notes.empty() ? "<nav>" : "</ul>\n<nav>";
  for (const Section& section : report.sections) {
    html += "<a href=\"#" + markup_text(section.id) + "\">" + markup_text(section.heading) + "</a>";
  }
  return html + "</nav></header>\n";
}

/// The place of the 3D view, which the script fills.
std::string map_html(const Report& report, bool scripted) {
  if (!report.map) return "";
  const std::string why = scripted ? "The 3D view of the map needs JavaScript and WebGL."
                                   : "The 3D view was not built: this program was built without the libraries that it "
                                     "needs (from npm). The map itself is in map.pcd.";
  return "<section id=\"map\" aria-label=\"Map\"><p class=\"missing\">" + why + "</p></section>\n";
}

std::string head_html(const Report& report, const WebBundle& bundle) {
  const std::string scripts = bundle.script.empty() ? "'none'" : "'sha256-" + std::string(bundle.script_digest) + "'";
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\">\n<meta http-equiv=\"Content-Security-Policy\" "
         "content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action "
         "'none'; script-src " +
         scripts + "\">\n<meta name=\"color-scheme\" content=\"light dark\">\n" + element("title", report.title) +
         "\n<style>" + std::string(bundle.style) + std::string(bundle.script_style) + "</style></head>\n";
}

/// Removes the plots of an earlier report: of a run with truth, say, where this one has none. Other files stay.
void remove_plots(const std::filesystem::path& folder) {
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(folder, missing)) {
    if (entry.path().extension() != ".svg") continue;
    std::string begin(svg_beginning().size(), ' ');
    std::ifstream(entry.path(), std::ios::binary).read(begin.data(), std::streamsize(begin.size()));
    if (begin == svg_beginning()) std::filesystem::remove(entry.path(), missing);
  }
}

}  // namespace

std::string html_report(const Report& report) {
  const WebBundle bundle = web_bundle();
  const bool scripted = !bundle.script.empty();
  std::string html = head_html(report, bundle) + "<body>\n" + header_html(report) + "<main>\n";
  html += map_html(report, scripted);
  for (const Section& section : report.sections) html += section_html(section);
  html += "</main>\n";
  if (scripted) {
    html += "<script type=\"application/json\" id=\"report\">" + report_json(report) + "</script>\n<script>";
    html += std::string(bundle.script) + "</script>\n";
    for (const std::string& layer : later_layers_json(report))  // the script runs before they are there
      html += "<script type=\"application/json\" class=\"layer\">" + layer + "</script>\n";
  }
  return html + "</body></html>\n";
}

void write_report(const std::filesystem::path& folder, const Report& report) {
  const std::filesystem::path plots = folder / kPlotsFolder;
  std::error_code error;
  std::filesystem::create_directories(plots, error);
  if (error) throw Error(plots.string(), "cannot be made a folder for plots: " + error.message());
  remove_plots(plots);
  for (const Section& section : report.sections) {
    for (const Plot& plot : section.plots) write_text(plots / (plot.id + ".svg"), svg_file(plot));
  }
  write_text(folder / "report.html", html_report(report));
}

}  // namespace tilth
