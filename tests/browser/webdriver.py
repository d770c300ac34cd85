"""What an engine has in common that is driven by a driver of WebDriver, as selenium speaks to it."""


class ByWebDriver:
    """driver: selenium's."""

    def load(self, url):
        self.driver.get(url)

    def reload(self):
        self.driver.refresh()

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def perform(self, source):
        self.driver.execute("actions", {"actions": [source]})
