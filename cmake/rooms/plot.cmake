target_compile_options(tilth_plot PRIVATE ${TILTH_QUICKLY_COMPILED})
