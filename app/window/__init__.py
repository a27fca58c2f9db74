"""The main window: its menus, keys, look and preferences."""
