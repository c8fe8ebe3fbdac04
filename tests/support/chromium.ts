/**
 * How the tests start Chromium: as root too, and without look-ups of its own. WebGL2 comes from SwiftShader;
 * Playwright already passes --enable-unsafe-swiftshader. The shell draws no window around the page, which is a
 * fifth faster. CHROMIUM names another executable.
 */
export const chromium = {
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium-headless-shell',
  args: [
    '--no-sandbox',
    '--disable-quic',
    '--no-first-run',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
  ],
};
