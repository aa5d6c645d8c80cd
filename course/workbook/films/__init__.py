"""Films: one question that moves a module, each an exhibit for the stage."""
