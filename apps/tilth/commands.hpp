// One subcommand a file: each adds itself to the command line, with its options, help and callback.
// A callback throws tilth::Error on bad input; what it returns through `exit_code` is the program's.
#pragma once

namespace CLI {
class App;
}

namespace tilth::app {

void add_run(CLI::App& app, int& exit_code);
void add_pipelines(CLI::App& app, int& exit_code);
void add_config(CLI::App& app, int& exit_code);
void add_evaluate(CLI::App& app, int& exit_code);
void add_evaluate_map(CLI::App& app, int& exit_code);
void add_info(CLI::App& app, int& exit_code);
void add_simulate(CLI::App& app, int& exit_code);
void add_convert(CLI::App& app, int& exit_code);
void add_live(CLI::App& app, int& exit_code);
void add_play(CLI::App& app, int& exit_code);
void add_score_filter(CLI::App& app, int& exit_code);
void add_score_basin(CLI::App& app, int& exit_code);
void add_assess(CLI::App& app, int& exit_code);
void add_score_moving(CLI::App& app, int& exit_code);
void add_view(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_sweep(CLI::App& app, int& exit_code);
void add_calibrate(CLI::App& app, int& exit_code);
void add_map(CLI::App& app, int& exit_code);
void add_localize(CLI::App& app, int& exit_code);
void add_job(CLI::App& app, int& exit_code);
void add_sensors(CLI::App& app, int& exit_code);
void add_completion(CLI::App& app, int& exit_code);
void add_manual(CLI::App& app, int& exit_code);

}  // namespace tilth::app
