"""The commands of `cfree`, a file each; `scenes` has those for scenes alone, `check` and `convert`."""
