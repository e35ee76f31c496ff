"""Chromium before a live page, for the tests of this folder. Needs python3-selenium and chromium-driver."""
import sys
import tempfile
from pathlib import Path

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from patience import patience, wait_until

__all__ = ["Browser", "Keys"]


class Browser:
    """One browser of its own, with its own cookies."""

    def __init__(self, width=1280, height=860, dark=False):
        self.home = tempfile.TemporaryDirectory(prefix="rung-web-")
        options = webdriver.ChromeOptions()
        options.binary_location = "/usr/bin/chromium"
        for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-dev-shm-usage",
                     f"--user-data-dir={self.home.name}", f"--window-size={width},{height}", "--hide-scrollbars",
                     "--force-color-profile=srgb"):
            options.add_argument(word)
        if dark:
            options.add_argument("--force-dark-mode")
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.driver.set_script_timeout(patience())

    def open(self, link):
        self.driver.get(link)
        self.until("return document.body.dataset.scan !== undefined", "the first picture")
        return self

    def js(self, script, *words):
        return self.driver.execute_script(script, *words)

    def until(self, script, what, *words):
        """Waits until the script returns something true, which is the result."""
        value = wait_until(lambda: self.js(script, *words), step=0.02)
        if value is None:
            raise AssertionError(f"never: {what}; state {self.text('#state')!r}, toast {self.text('#toast')!r}")
        return value

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.js("return document.querySelector(arguments[0])?.textContent ?? ''", selector)

    def click(self, selector):
        self.find(selector).click()

    def keys(self, *keys):
        webdriver.ActionChains(self.driver).send_keys(*keys).perform()

    def phone(self, width=390, height=844):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                    {"width": width, "height": height, "deviceScaleFactor": 2, "mobile": True})

    def shot(self, path):
        self.driver.save_screenshot(str(path))

    def errors(self):
        """What the page has complained about."""
        return [line["message"] for line in self.driver.get_log("browser") if line["level"] == "SEVERE"]

    def close(self):
        self.driver.quit()
        self.home.cleanup()
