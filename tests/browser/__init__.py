"""The cockpit in a real browser: headless Chromium, a real cockpit, real controllers on fake buses."""
