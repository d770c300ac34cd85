"""The screens on which the pages are looked at, and how large a control is at least, in px."""

PHONE, DESKTOP = (390, 844), (1280, 800)
TOUCH_SCREENS = [(360, 640), (390, 844), (844, 390), (820, 1180), (1180, 820)]
FINGER, MOUSE = 44, 24
