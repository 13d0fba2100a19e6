// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Implements html_page.h.
#include "report/html_page.h"

#include "report/case_parameters.h"
#include "report/escaped.h"

#include <vtkBase64Utilities.h>

#include <fstream>

namespace eccentra::report {
namespace {

std::string picture(const std::filesystem::path& file, const std::string& caption) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    return "";
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  std::string text(2 * bytes.size() + 8, '\0');
  const auto length = vtkBase64Utilities::Encode(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                                                 reinterpret_cast<unsigned char*>(text.data()), 0);
  text.resize(length);
  return "<figure><img alt=\"" + caption + "\" src=\"data:image/png;base64," + text + "\"><figcaption>" + caption +
         "</figcaption></figure>\n";
}

std::string table_of(const Case& data) {
  std::string rows;
  for (const Parameter& parameter : parameters_of(data))
    rows += "<tr><td>" + escaped(parameter.name) + "</td><td>" + escaped(parameter.value) + "</td><td>" +
            escaped(parameter.meaning) + "</td></tr>\n";
  return rows.empty() ? ""
                      : "<details><summary>What " + escaped(data.name) + " was computed with</summary>\n<table>\n" +
                            rows + "</table></details>\n";
}

} // namespace

std::string html_page(const std::vector<Case>& cases, const std::vector<Summary>& summaries,
                      const std::filesystem::path& folder) {
  std::string title;
  std::string parameters;
  for (const Case& data : cases)
    parameters += table_of(data);
  for (const Summary& s : summaries)
    title += (title.empty() ? "" : ", ") + escaped(s.name);
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + title +
         "</title>\n<style>body{font:16px sans-serif;max-width:1100px;margin:2em auto;padding:0 1em}"
         "pre{overflow-x:auto;background:#f6f6f6;padding:1em}img{max-width:100%}figure{margin:1em "
         "0}table{border-collapse:collapse}td{padding:0.1em 1em 0.1em "
         "0}</style></head>\n<body><h1>" +
         title + "</h1>\n<pre>" + escaped(to_text(summaries) + classes_text(summaries)) + "</pre>\n" + parameters +
         picture(folder / "beds.png", "Bodies coloured by speed in front of the speed of the fluid") +
         picture(folder / "scene.png",
                 "Bodies coloured by speed, walls, and the speed of the fluid where there is one") +
         picture(folder / "strip.png", "From the start to the end of the run") +
         picture(folder / "film.png", "The run as a film") +
         picture(folder / "charts.png", "Profile, flux, pressure gradient and cost") + "</body></html>\n";
}

} // namespace eccentra::report
