// What a study writes: study.csv, study.json and the plot.
#pragma once
#include "app/study_figures.h"

namespace windhover::app {

/// study.csv, a row for each run, and study.json, the same with what the plot needs.
void write_study(const std::filesystem::path& out, const Study& study, const std::vector<StudyRow>& rows);

/// Runs `python3 -m windhover.study`, which draws study.png; returns what went wrong, or nothing.
std::string plot_study(const std::filesystem::path& out);

}  // namespace windhover::app
