"""The JSON scene: its values, its models, its round shapes."""
